#pragma once

#include <memory>
#include <optional>
#include <string>

#include "saca/base/core/clock.h"
#include "saca/lab/encounter/encounter.h"
#include "saca/lab/encounter/provenance.h"
#include "saca/lab/installation/inputs.h"
#include "saca/lab/model_access/chosen_model.h"
#include "saca/lab/runs/forced_plan.h"
#include "saca/lab/runs/run_files.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/thinking/danger/danger.h"

namespace saca::runs {

/// What a run is made with, as whoever asks for it names it (`saca run`).
struct RunRequest {
  std::string scenario;           ///< its file, or the name of a shipped one
  std::string pace = "real";      ///< or "lockstep"
  std::string trigger = "value";  ///< or "t1": never before T1
  std::string memory;             ///< the bank; empty: none
  std::string model = "local";    ///< as model_access::open_model takes it
  std::string record_replies;     ///< file for the model's replies; empty: none
  ForcedPolicy forced;
  std::optional<std::uint64_t> seed;
  std::string atlas;          ///< a file, or "off"; empty: the usual one
  std::string danger;         ///< "tables" or "off"; empty: what was learnt of the car, if anything
  bool empty_memory = false;  ///< a bank that is not there yet begins without the shipped cases
  bool no_learning = false;   ///< memory is asked, and nothing is added to it
  std::string output = "runs";  ///< folder of records and reports
  std::string report;           ///< empty: beside the record
  std::string trace;            ///< empty: none
  std::string tape;             ///< empty: none
  std::string command;          ///< that was typed, for the record
  std::string date;             ///< UTC, ISO 8601
};

/// All that a run is made with.
struct RunMeans {
  installation::ScenarioInputs inputs;
  encounter::Provenance provenance;
  runtime::ThinkingCosts costs;
  std::optional<atlas::Atlas> atlas;
  std::optional<danger::DangerModel> danger;
  std::shared_ptr<memory::Store> memory;  ///< nullptr: none is wanted
  model_access::ChosenModel model;
  std::optional<manoeuvre::Plan> forced;
};

/// Opens what the request names, once it is known that its files can be written. That "local" is
/// not there is noticed, and the run goes on without a model.
/// @param clock  outlives them
[[nodiscard]] Result<std::unique_ptr<RunMeans>> open_means(const installation::Installation& here,
                                                           const RunRequest& request, Clock& clock);

/// What an encounter is run with by these means, which outlive it.
[[nodiscard]] encounter::Setup setup_of(const RunMeans& means, const RunRequest& request,
                                        Clock& clock);

/// Where what comes of it goes.
/// @param scenario  its name
[[nodiscard]] RunFiles files_of(const RunRequest& request, const std::string& scenario);

}  // namespace saca::runs
