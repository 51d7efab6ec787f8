#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/paper_comparison/reply_timing.h"
#include "saca/lab/paper_comparison/table_request.h"
#include "saca/onboard/manoeuvre/car.h"
#include "saca/runtime/planes.h"
#include "saca/thinking/intent/model.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::paper_comparison {

/// A model whose replies are timed.
struct AskedModel {
  std::string choice;       ///< as `--llm` takes it
  const char* option = "";  ///< that named it, for messages
  const char* title = "";   ///< for readers
  const char* key = "";     ///< of the figures
};

/// The model, and the one without fine-tuning; those that there are.
[[nodiscard]] std::vector<AskedModel> asked_models(const suites::ThinkingOptions& thinking);

/// Replies of one model in the scenes of one table.
struct TimedModel {
  std::string table;  ///< its name
  std::string title;  ///< of the model
  std::string key;    ///< of the figures
  ReplyTimes times;
};

/// What questions come of and how models are opened. What it points to outlives the call.
struct ReplyClock {
  std::filesystem::path scenarios;  ///< folder of those that ship
  const manoeuvre::Car* car = nullptr;
  const runtime::PlanesSetup* setup = nullptr;  ///< its clock is the models'
  const intent::Model* intent = nullptr;
  std::function<Result<std::unique_ptr<language_model::LanguageModel>>(const AskedModel& asked)>
      open;  ///< at real pace
};

/// Puts the first questions in about ten draws of each wanted table of which the paper has replies,
/// as many of each condition, to each model: timed_replies, a minute's patience with each.
/// @return  of those of whom there was time to ask before an interrupt that is watched for
[[nodiscard]] Result<std::vector<TimedModel>> timed_models(const ReplyClock& clock,
                                                           const TableRequest& request);

}  // namespace saca::paper_comparison
