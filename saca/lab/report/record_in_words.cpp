// Longer than 400 lines: one explanation from its first sentence to its last, all of the same
// record.
#include "saca/lab/report/record_in_words.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "saca/base/core/printable.h"
#include "saca/base/formats/json_reader.h"
#include "saca/base/formats/json_text.h"
#include "saca/lab/report/verdicts_in_words.h"
#include "saca/onboard/manoeuvre/plan.h"
#include "saca/onboard/reflex/reflex_plane.h"

namespace saca::report {
namespace {

using nlohmann::json;

/// What a policy's short name, or an intention's letters, stand for; themselves where not known.
std::string meaning(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 16> meanings{{
      {"AEB", "emergency braking"},
      {"AES-L", "a lane change to the left"},
      {"AES-R", "a lane change to the right"},
      {"ES-B-L", "a braked lane change to the left"},
      {"ES-B-R", "a braked lane change to the right"},
      {"T-D-L", "a drift to a stop, facing left"},
      {"T-D-R", "a drift to a stop, facing right"},
      {"NI", "doing nothing"},
      {"M", "keeping lane and speed"},
      {"LC", "a lane change to the left"},
      {"RC", "a lane change to the right"},
      {"FB", "braking"},
      {"LB", "braking while changing to the left"},
      {"RB", "braking while changing to the right"},
      {"stop", "stopping"},
      {"cross", "crossing"},
  }};
  const auto* const found = std::find_if(meanings.begin(), meanings.end(),
                                         [&](const auto& one) { return one.first == name; });
  return std::string(found == meanings.end() ? name : found->second);
}

std::string percent(double probability) {
  return fmt::format("{:.0f} %", 100.0 * probability);
}

/// A number that should be that of a list's entry is not.
class NoSuchEntry : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An entry by its number, which stands elsewhere in the record.
/// @param key  where
/// @throws NoSuchEntry  where there is none
const json& entry(const json& list, const json& number, std::string_view key) {
  if (!number.is_number_unsigned() || number.get<std::size_t>() >= list.size()) {
    throw NoSuchEntry(fmt::format("{}: want a number below {}, got {}", key, list.size(),
                                  formats::JsonReader::shown(number)));
  }
  return list.at(number.get<std::size_t>());
}

/// What became of one plan of a verdict.
struct PlanVerdict {
  std::string name;
  std::string short_name;  ///< of its policy
  std::string policy;      ///< in words
  bool drivable = false;
  double harm = 0.0;
  double contact = 0.0;
  std::optional<double> harm_as_seen;  ///< nullopt: nobody was reckoned with who is not seen
  bool admissible = false;
  bool is_braking = false;
  bool chosen = false;
};

/// A record, and what all paragraphs look up in it.
class Story {
 public:
  using Sentences = std::vector<std::string>;

  explicit Story(const json& record) : record_(record), decision_(record.at("decision")) {
    if (decision_.is_null() || decision_.at("verdict").is_null()) {
      return;
    }
    const json& verdict = decision_.at("verdict");
    most_ = verdict.at("admissible_harm").is_null()
                ? std::nullopt
                : std::optional(verdict.at("admissible_harm").get<double>());
    for (const json& plan : verdict.at("plans")) {
      PlanVerdict judged{.name = plan_name(plan),
                         .short_name = plan.at("name").get<std::string>(),
                         .policy = meaning(plan.at("name").get<std::string>()),
                         .chosen = is_same_plan(plan, decision_)};
      judged.is_braking = plan.at("policy") == manoeuvre::index(manoeuvre::PolicyId::aeb);
      judged.drivable = !plan.at("harm").is_null();
      if (judged.drivable) {
        judged.harm = plan.at("harm").get<double>();
        judged.contact = plan.at("contact").get<double>();
        judged.admissible = most_ && judged.harm <= *most_;
        if (const auto seen = plan.find("harm_as_seen"); seen != plan.end()) {
          judged.harm_as_seen = seen->get<double>();
        }
      }
      judged_.push_back(judged);
    }
  }

  /// @param about  of the paragraph that is being told, for messages
  [[nodiscard]] std::vector<Paragraph> told(std::string& about) const {
    std::vector<Paragraph> all;
    const auto add = [&](const char* title, Sentences (Story::*tell)() const) {
      about = title;
      all.push_back({about, (this->*tell)()});
    };
    add("In short", &Story::in_short);
    add("What threatened", &Story::threatened);
    if (!decision_.is_null()) {
      add("What was believed of the others", &Story::believed);
      add("What each plan was expected to end in", &Story::expected);
      add("Which plans were admissible", &Story::admissible);
      add("What was chosen, and by which rule", &Story::chosen);
      add("Why not the others", &Story::not_chosen);
      add("What was switched", &Story::switched);
    }
    add("How it ended", &Story::ended);
    add("What hindsight says", &Story::hindsight);
    return all;
  }

 private:
  /// The first event of this kind and plane, as it was told then; empty: none.
  [[nodiscard]] std::string event(std::string_view kind, std::string_view plane) const {
    for (const json& one : record_.at("events")) {
      if (one.at("kind") == kind && one.at("plane") == plane) {
        return fmt::format("At {:.2f} s, {}.", one.at("t_s").get<double>(),
                           one.at("text").get<std::string>());
      }
    }
    return {};
  }
  /// "parked vans, wet leaves".
  [[nodiscard]] std::string cues() const {
    std::string names;
    for (const json& cue : record_.value("cues", json::array())) {
      std::string name = cue.at("kind").get<std::string>();
      std::replace(name.begin(), name.end(), '_', ' ');
      names += (names.empty() ? "" : ", ") + name;
    }
    return names;
  }
  /// The statements that are shown as the reason of the cached plan, one sentence; empty: none.
  [[nodiscard]] std::string weighed() const {
    const auto number = decision_.find("preview");
    if (number == decision_.end() || number->is_null()) {
      return {};
    }
    const json& preview = entry(record_.at("previews"), *number, "decision.preview");
    if (!preview.contains("explanation") || preview.at("explanation").is_null()) {
      return {};
    }
    std::string text = preview.at("explanation").at("text").get<std::string>();
    while (text.ends_with('\n')) {
      text.pop_back();
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    const bool by_model = preview.at("explanation").at("from") != "facts";
    return fmt::format("{}: {}",
                       by_model ? "The model's reasons, checked" : "Reasons, by the figures", text);
  }
  [[nodiscard]] double decided_at() const { return decision_.at("time_s").get<double>(); }
  [[nodiscard]] std::string source() const { return decision_.at("source").get<std::string>(); }

  [[nodiscard]] Sentences in_short() const;
  [[nodiscard]] Sentences threatened() const;
  [[nodiscard]] Sentences believed() const;
  [[nodiscard]] Sentences expected() const;
  [[nodiscard]] Sentences admissible() const;
  [[nodiscard]] Sentences chosen() const;
  [[nodiscard]] Sentences not_chosen() const;
  [[nodiscard]] Sentences switched() const;
  [[nodiscard]] Sentences ended() const;
  [[nodiscard]] Sentences hindsight() const;
  [[nodiscard]] std::string about_to_happen() const;
  [[nodiscard]] std::string considered() const;
  [[nodiscard]] std::string because() const;
  [[nodiscard]] const json* last_frame() const;
  [[nodiscard]] std::string why_not(const PlanVerdict& plan) const;
  [[nodiscard]] bool nothing_harms_nobody() const {
    return std::any_of(judged_.begin(), judged_.end(), [](const PlanVerdict& plan) {
      return plan.name == "NI" && plan.drivable && plan.contact == 0.0 && plan.harm == 0.0;
    });
  }

  [[nodiscard]] bool is_choice_admissible() const {
    return std::any_of(judged_.begin(), judged_.end(),
                       [](const PlanVerdict& plan) { return plan.chosen && plan.admissible; });
  }

  const json& record_;
  const json& decision_;
  std::vector<PlanVerdict> judged_;  ///< of the verdict that was decided by
  std::optional<double> most_;       ///< admissible harm
};

/// The last picture before what was decided; nullptr: there is none.
const json* Story::last_frame() const {
  const json& frames = record_.at("frames");
  const auto found = std::find_if(frames.rbegin(), frames.rend(), [&](const json& frame) {
    return frame.at("t_s").get<double>() <= decided_at();
  });
  return found == frames.rend() ? nullptr : &*found;
}

Story::Sentences Story::threatened() const {
  Sentences told;
  if (const std::string first = event("preview", "world"); !first.empty()) {
    told.push_back(first);
  }
  if (decision_.is_null()) {
    told.push_back(
        fmt::format("No conflict came within {:.1f} s, so nothing set off the trigger "
                    "and nothing had to be decided.",
                    record_.at("thresholds").at("trigger_s").get<double>()));
    return told;
  }
  told.push_back(event("trigger", "reflex"));
  if (const json* const frame = last_frame()) {
    const json& thresholds = record_.at("thresholds");
    const bool is_early =
        decision_.contains("waiting_cost") && decision_["waiting_cost"].is_number();
    const std::string or_before =
        is_early ? fmt::format(
                       ", or before where to wait for two more looks is expected to harm by "
                       "more than {:.4f} more",
                       thresholds.at("waiting_cost").get<double>())
                 : "";
    told.push_back(fmt::format(
        "The trigger fires where a conflict is at most {:.1f} s away{}; the ego drove at {:.1f} "
        "m/s.",
        thresholds.at("trigger_s").get<double>(), or_before,
        frame->at("ego").at("speed_mps").get<double>()));
  }
  return told;
}

Story::Sentences Story::believed() const {
  Sentences told;
  for (const json& seen : record_.at("intentions")) {
    const json& times = seen.at("times_s");
    const auto after =
        std::upper_bound(times.begin(), times.end(), decided_at(),
                         [](double time, const json& one) { return time < one.get<double>(); });
    if (after == times.begin()) {
      continue;  // not seen yet
    }
    const auto last = static_cast<std::size_t>(after - times.begin()) - 1;
    std::istringstream numbers(seen.at("now_permille").at(last).get<std::string>());
    std::vector<std::pair<double, std::string>> all;
    for (const json& letter : seen.at("of")) {
      double permille = 0.0;
      numbers >> permille;
      all.emplace_back(permille, letter.get<std::string>());
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string text;
    for (const auto& [permille, letter] : all) {
      if (permille > 0.0) {
        text += fmt::format("{}{} with {:.1f} %", text.empty() ? "" : ", ", meaning(letter),
                            permille / 10.0);
      }
    }
    told.push_back(fmt::format("At {:.2f} s {} was thought to intend: {}.",
                               times.at(last).get<double>(), seen.at("actor").get<std::string>(),
                               text));
  }
  if (told.empty()) {
    told.emplace_back("No road user was seen who could intend anything.");
  }
  return told;
}

Story::Sentences Story::expected() const {
  if (judged_.empty()) {
    return {"There was no verdict: nothing was expected of any plan."};
  }
  const double time = decision_.at("verdict").at("t_s").get<double>();
  Sentences told{fmt::format("The scene that was judged is that of {:.2f} s; {}.", time,
                             decision_.at("by_atlas").get<bool>()
                                 ? "the forecaster's verdict was too old, so the reflex plane read "
                                   "the plans from the atlas"
                                 : "the forecaster drove every plan against draws of what the "
                                   "others may do")};
  if (std::any_of(judged_.begin(), judged_.end(),
                  [](const PlanVerdict& plan) { return plan.harm_as_seen.has_value(); })) {
    told.push_back(fmt::format(
        "Reckoned with was also what is not seen but likelier here than elsewhere: {}.", cues()));
  }
  for (const PlanVerdict& plan : judged_) {
    told.push_back(
        plan.drivable
            ? fmt::format("{}, {}: expected harm {:.4f}{}, chance of contact {}.", plan.name,
                          plan.policy, plan.harm,
                          plan.harm_as_seen
                              ? fmt::format(" ({:.4f} by what is seen alone)", *plan.harm_as_seen)
                              : "",
                          percent(plan.contact))
            : fmt::format("{}, {}: cannot be driven from there.", plan.name, plan.policy));
  }
  return told;
}

Story::Sentences Story::admissible() const {
  if (!most_) {
    return {"None could be held against the others."};
  }
  std::string names;
  for (const PlanVerdict& plan : judged_) {
    names += plan.admissible ? (names.empty() ? "" : ", ") + plan.name : "";
  }
  return {
      fmt::format("A plan is admissible where it can be driven and its expected harm is at most "
                  "{:.4f}: the forecasts cannot tell that from the best.",
                  *most_),
      fmt::format("Admissible were {}.", names)};
}

std::string Story::because() const {
  const std::string by = source();
  if (by == "forced") {
    return "the user asked for it, whatever was thought";
  }
  if (by == "memory") {
    return "a case in memory had this plan ready for a situation like this one";
  }
  if (by == "model") {
    return "the language model had chosen this plan for a situation like this one, and the check "
           "by rollout had passed";
  }
  if (by == "fallback") {
    return "nothing could be judged, or what was decided on could not be driven from here: "
           "emergency braking is the fallback";
  }
  if (decision_.at("name") == "NI") {
    return nothing_harms_nobody() ? "no draw of what the others may do has contact where nothing "
                                    "is done"
                                  : "it is admissible: no plan is expected to harm so much less "
                                    "that the forecasts could tell it from doing nothing, which "
                                    "is looked at again as long as a conflict is within T1";
  }
  if (decision_.at("name") == "AEB" && !is_choice_admissible()) {
    return "doing nothing may end in contact and no other plan is admissible; emergency braking "
           "was begun although it is not";
  }
  if (decision_.at("name") == "AEB") {
    return "doing nothing may end in contact and braking is admissible: it comes first where full "
           "braking is admissible, else where no lane change harms less; of the ways to brake it "
           "is the hardest of those that harm as little as the best";
  }
  return "doing nothing may end in contact, full braking is not admissible and no gentler braking "
         "harms less: it is the mildest of the admissible plans that leave the lane";
}

std::string Story::about_to_happen() const {
  std::string told = fmt::format("At {:.2f} s ", decided_at());
  const auto threat = decision_.find("threat");
  told += threat == decision_.end() || threat->is_null()
              ? "a conflict came near"
              : fmt::format("a conflict with {} came near", threat->get<std::string>());
  if (const json* const frame = last_frame()) {
    if (const auto conflict = frame->find("conflict_s");
        conflict != frame->end() && !conflict->is_null()) {
      told += fmt::format(", {:.2f} s away", conflict->get<double>());
    }
    told += fmt::format("; the ego drove at {:.1f} m/s",
                        frame->at("ego").at("speed_mps").get<double>());
  }
  for (const json& one : record_.at("hindsight")) {
    if (one.at("name") == "NI" && !one.at("harm").is_null()) {
      told += fmt::format(". Had nothing been done, this would have come of it: {} (harm {:.4f})",
                          one.at("text").get<std::string>(), one.at("harm").get<double>());
    }
  }
  return told + ".";
}

std::string Story::considered() const {
  if (judged_.empty() || !most_) {
    return "No plan could be judged.";
  }
  // Of each policy the plan that harms least; one that may be chosen first.
  std::vector<const PlanVerdict*> best;
  for (const PlanVerdict& plan : judged_) {
    const auto same = std::find_if(best.begin(), best.end(), [&](const PlanVerdict* one) {
      return one->short_name == plan.short_name;
    });
    if (same == best.end()) {
      best.push_back(&plan);
    } else if (plan.drivable && (!(*same)->drivable || plan.harm < (*same)->harm)) {
      *same = &plan;
    }
  }
  std::string admissible;
  std::string rejected;
  for (const PlanVerdict* const one : best) {
    std::string& list = one->admissible ? admissible : rejected;
    list += (list.empty() ? "" : ", ") + one->policy;
    list += one->drivable ? fmt::format(" ({:.4f})", one->harm) : " (cannot be driven)";
  }
  return fmt::format(
      "Considered were {} plans. These kinds had one whose expected harm is at most {:.4f}, which "
      "the forecasts cannot tell from the best: {}. Rejected as more harmful: {}.",
      judged_.size(), *most_, admissible, rejected.empty() ? "none" : rejected);
}

Story::Sentences Story::in_short() const {
  if (decision_.is_null()) {
    return threatened();
  }
  return {about_to_happen(), considered(),
          fmt::format("{}, {}, was begun because {}.", plan_name(decision_),
                      meaning(decision_.at("name").get<std::string>()), because())};
}

Story::Sentences Story::chosen() const {
  Sentences told{fmt::format("At {:.2f} s {} was begun (source: {}).", decided_at(),
                             plan_name(decision_), source())};
  if (!decision_.at("similarity").is_null()) {
    const double similarity = decision_.at("similarity").get<double>();
    const bool not_admissible = decision_.at("not_admissible").get<bool>();
    const bool by_arbiter = source() == name(reflex::Source::arbiter);
    const bool needless = reflex::was_needless(
        {.source = by_arbiter ? reflex::Source::arbiter : reflex::Source::fallback,
         .similarity = similarity,
         .not_admissible = not_admissible});
    told.push_back(fmt::format(
        "The situation most like this one for which a plan was ready was like it to {}{}.",
        percent(similarity),
        not_admissible ? ", but that plan is expected to harm too much from here"
        : needless     ? ", but doing nothing is expected to be as good as that plan"
                       : ""));
  }
  told.push_back(fmt::format("It was begun because {}.", because()));
  if (source() == "memory" || source() == "model") {
    if (std::string reasons = weighed(); !reasons.empty()) {
      told.push_back(std::move(reasons));
    }
  }
  return told;
}

std::string Story::why_not(const PlanVerdict& plan) const {
  if (!plan.drivable) {
    return fmt::format("{}: it cannot be driven.", plan.name);
  }
  if (!plan.admissible) {
    return fmt::format("{}: its expected harm of {:.4f} is more than the admissible {:.4f}.",
                       plan.name, plan.harm, most_.value_or(0.0));
  }
  const std::string by = source();
  if (by == "memory" || by == "model") {
    return fmt::format("{}: admissible, but {} preferred another of the admissible plans.",
                       plan.name, by == "memory" ? "memory" : "the language model");
  }
  if (by != "arbiter") {
    return fmt::format("{}: admissible, but the choice was not made among the admissible plans.",
                       plan.name);
  }
  if (nothing_harms_nobody()) {
    return fmt::format("{}: admissible, but not needed.", plan.name);
  }
  if (decision_.at("name") == "NI") {
    return fmt::format(
        "{}: admissible, but the forecasts cannot tell it from doing nothing, which comes first.",
        plan.name);
  }
  if (plan.name == "NI") {
    return fmt::format("NI: admissible, but it may end in contact ({}), and something can be done.",
                       percent(plan.contact));
  }
  if (decision_.at("name") == "AEB") {
    return fmt::format("{}: admissible, but {}.", plan.name,
                       plan.is_braking ? "it is expected to harm more, or to harm as much and "
                                         "brakes less hard"
                                       : "braking comes first");
  }
  return fmt::format("{}: admissible, but it is {} what was chosen.", plan.name,
                     plan.is_braking ? "expected to harm more than" : "no milder than");
}

Story::Sentences Story::not_chosen() const {
  Sentences told;
  for (const PlanVerdict& plan : judged_) {
    if (!plan.chosen) {
      told.push_back(why_not(plan));
    }
  }
  if (told.empty()) {
    told.emplace_back("There was no verdict by which others could have been chosen.");
  }
  return told;
}

Story::Sentences Story::switched() const {
  Sentences told;
  std::string before = plan_name(decision_);
  for (const json& change : record_.at("switches")) {
    told.push_back(fmt::format("At {:.2f} s the supervisor began {} in place of {}, {}: {}.",
                               change.at("t_s").get<double>(), plan_name(change), before,
                               change.at("reason").get<std::string>(),
                               change.at("text").get<std::string>()));
    const Sentences why = why_then(record_, change);
    told.insert(told.end(), why.begin(), why.end());
    before = plan_name(change);
  }
  if (told.empty()) {
    told.push_back(fmt::format("Nothing: {} was carried out to its end.", before));
    const Sentences why = why_not_switched(record_);
    told.insert(told.end(), why.begin(), why.end());
  }
  return told;
}

Story::Sentences Story::ended() const {
  const json& result = record_.at("result");
  Sentences told;
  if (const std::string rest = event("rest", "world"); !rest.empty()) {
    told.push_back(rest);
  }
  told.push_back(fmt::format("The outcome: {}; harm {:.4f}.", result.at("text").get<std::string>(),
                             result.at("harm").get<double>()));
  if (!record_.at("driver").is_null()) {
    told.push_back(fmt::format("The recorded drive ended so: {}; harm {:.4f}.",
                               record_.at("driver").at("text").get<std::string>(),
                               record_.at("driver").at("harm").get<double>()));
  }
  return told;
}

Story::Sentences Story::hindsight() const {
  if (record_.at("best").is_null()) {
    return {"Nothing was decided, so there is nothing to compare."};
  }
  const json& all = record_.at("hindsight");
  const json& best = entry(all, record_.at("best"), "best");
  const json& own = entry(all, decision_.at("policy"), "decision.policy");
  const auto text_of = [](const json& one) {
    return one.at("harm").is_null()
               ? one.at("text").get<std::string>()
               : fmt::format("{}; harm {:.4f}", one.at("text").get<std::string>(),
                             one.at("harm").get<double>());
  };
  Sentences told{
      fmt::format("With what the others really did, {} would have been the best of the "
                  "eight policies from the trigger on: {}.",
                  plan_name(best), text_of(best))};
  told.push_back(best.at("policy") == own.at("policy")
                     ? "That is what was chosen."
                     : fmt::format("What was chosen, {}, would have led to this when kept to the "
                                   "end: {}.",
                                   plan_name(own), text_of(own)));
  return told;
}

}  // namespace

Result<std::vector<Paragraph>> explanation(std::string_view record, std::string_view source) {
  const auto refuse = [&](const std::string& what) {
    return Error{Error::Code::malformed, fmt::format("{}: {}", source, what)};
  };
  const auto read = formats::parse_json(record);
  if (!read.has_value()) {
    return refuse("want the JSON of a record (saca.record/1): " + read.error().message);
  }
  const json& document = read.value();
  if (!document.is_object()) {
    return refuse("want the JSON of a record (saca.record/1), got something else");
  }
  if (const auto schema = document.find("schema");
      schema == document.end() || *schema != "saca.record/1") {
    return refuse("schema: want \"saca.record/1\", got " +
                  (schema == document.end() ? "none" : formats::JsonReader::shown(*schema)));
  }
  std::string about = "the decision";
  try {
    return Story(document).told(about);
  } catch (const NoSuchEntry& problem) {
    return refuse(problem.what());
  } catch (const json::exception& problem) {  // a key that is missing or of another type
    return refuse(fmt::format("want a whole record (saca.record/1), got, for \"{}\": {}", about,
                              one_line(problem.what())));
  }
}

}  // namespace saca::report
