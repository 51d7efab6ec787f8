#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/thinking/language_model/language_model.h"

namespace saca::language_model::protocol {

// What SACA and the program that runs the language model say to each other: one JSON object per
// line, described in docs/model-protocol.md. Both sides read and write with these functions.

constexpr int version = 1;

/// To the model: the system part of the prompt, once, before the first question.
struct Start {
  std::string system;
};
/// To the model: think about these scenes.
struct Ask {
  int id = 0;  ///< comes back with every event that belongs to it
  std::vector<std::string> scenes;
  double budget = 0.0;                     ///< from its arrival to the last answer [s], > 0
  int max_tokens = 0;                      ///< of reasoning per scene, >= 0
  int sampling_seed = 0;                   ///< as AskOptions has it; 0 where a line does not say
  std::vector<std::string> grammars = {};  ///< likewise; none where a line does not say
};
/// To the model: stop thinking about them. Nothing where that ask is over.
struct Cancel {
  int id = 0;
};
/// To the model: say what you are.
struct InfoRequest {};
using Request = std::variant<Start, Ask, Cancel, InfoRequest>;

/// From the model: the system part is evaluated, questions can come.
struct Ready {
  std::string description;  ///< name and type of the weights
  int system_tokens = 0;
  double load_time = 0.0;  ///< from the program's start to here [s]
};
struct PromptRead {
  int id = 0;
  std::size_t scene = 0;
  int tokens = 0;
};
struct Text {
  int id = 0;
  std::size_t scene = 0;
  std::string text;
};
struct AnswerMessage {
  int id = 0;
  std::size_t scene = 0;
  Answer::Kind kind = Answer::Kind::first;
  std::array<double, manoeuvre::num_policies> probability{};  ///< sums to 1
};
/// The ask is over.
struct Done {
  int id = 0;
  std::vector<int> reply_tokens;  ///< one per scene
  double prompt_time = 0.0;       ///< spent in prompts [s]
  double reply_time = 0.0;        ///< spent in reasoning [s]
  bool overran = false;  ///< an answer was missing when the budget was spent or the ask cancelled
};
struct Info {
  std::string description;
  std::string file;
  std::uint64_t weight_bytes = 0;
  std::uint64_t resident_bytes = 0;  ///< of the model's process
  int threads = 0;
};
/// A request could not be carried out; the program lives on.
struct FailureMessage {
  std::optional<int> id;
  std::string message;
  bool late = false;  ///< for want of time
};
using Event = std::variant<Ready, PromptRead, Text, AnswerMessage, Done, Info, FailureMessage>;

/// One line, without its end.
[[nodiscard]] std::string line(const Request& request);
[[nodiscard]] std::string line(const Event& event);

/// @param line  anything
/// @return      malformed, naming the key, what was wanted and what came
[[nodiscard]] Result<Request> request_from(std::string_view line);
[[nodiscard]] Result<Event> event_from(std::string_view line);

}  // namespace saca::language_model::protocol
