#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "saca/lab/eval/decision_point.h"
#include "saca/lab/eval/suite_source.h"

namespace saca::eval {

/// One encounter in which all eight were tried once, as it is written.
struct Finding {
  std::string family;
  std::uint64_t number = 0;    ///< of the sample
  std::optional<double> time;  ///< when the trigger fires [s]; nullopt: never, and nothing is tried
  std::array<std::optional<double>, manoeuvre::num_policies> harm;  ///< nullopt: cannot be driven
  std::array<bool, manoeuvre::num_policies> contact{};
  manoeuvre::PolicyId best = manoeuvre::PolicyId::no_intervention;  ///< by the one ordering

  bool operator==(const Finding&) const = default;
};

/// What was found when all eight began at `time`; without family and number.
[[nodiscard]] Finding finding_of(double time, const encounter::Hindsights& tried);

/// Tries all eight from the trigger of each scenario on; without families and numbers. One does not
/// depend on the others.
/// @param threads  >= 1; they do not change the result
[[nodiscard]] std::vector<Finding> look_into(std::span<const scenario::Scenario> scenarios,
                                             const manoeuvre::Car& car,
                                             const collision::HarmModel& harm, int threads);

/// One line, for journals; and back, to the last bit. nullopt: no such line.
[[nodiscard]] std::string line_of(const Finding& finding);
[[nodiscard]] std::optional<Finding> finding_from(std::string_view line);

/// A survey: all eight policies tried in the first encounters of a suite.
struct SurveyWork {
  const SuiteSource* source = nullptr;
  const manoeuvre::Car* car = nullptr;
  const collision::HarmModel* harm = nullptr;
  int count = 0;                  ///< encounters, >= 0
  int threads = 1;                ///< >= 1; they do not change the result
  std::filesystem::path journal;  ///< an interrupted survey goes on from it; its folder is there
  std::string title;              ///< of the journal: names everything on which the findings depend
};

/// Who watches a survey.
struct SurveyWatch {
  std::function<bool()> is_interrupted = [] { return false; };  ///< asked between encounters
  /// So many are done, of which so many were remembered.
  std::function<void(int done, int remembered)> progress = [](int, int) {};
};

/// Looks into all of them.
/// @return  in the order of their numbers; nullopt: interrupted. An error where the journal is of
///          other work or an encounter cannot be drawn
[[nodiscard]] Result<std::optional<std::vector<Finding>>> survey(const SurveyWork& work,
                                                                 const SurveyWatch& watch = {});

/// What an encounter teaches.
enum class Lesson : std::uint8_t {
  never_triggers,   ///< nobody has to decide anything
  nothing_needed,   ///< doing nothing harms nobody
  nothing_helps,    ///< doing nothing harms, and no policy does less harm
  several_as_good,  ///< the least harm is that of several: the mildest of them is taken
  one_alone,        ///< one does less harm than every other, doing nothing included
};

/// "Less" is a lower class of harm (collision/ordering.h).
struct Taught {
  Lesson lesson = Lesson::never_triggers;
  std::optional<manoeuvre::PolicyId> alone;  ///< it does less harm than every other, whatever the
                                             ///< lesson: doing nothing may be it
  double margin = 0.0;                       ///< of it: harm of the second best above its own
};
[[nodiscard]] Taught lesson_of(const Finding& finding);

/// How often each policy is strictly best, by how much, and where nothing helps.
struct Balance {
  int count = 0;
  std::array<int, 5> lessons{};                          ///< by Lesson
  std::array<int, manoeuvre::num_policies> alone{};      ///< strictly best
  std::array<int, manoeuvre::num_policies> best{};       ///< best, ties broken by mildness
  std::array<double, manoeuvre::num_policies> margin{};  ///< median where alone; 0 where never
};
[[nodiscard]] Balance balance(std::span<const Finding> findings);

}  // namespace saca::eval
