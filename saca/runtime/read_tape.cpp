// Longer than 400 lines: one reader for each structure of a tape, in the order in which
// docs/formats.md has them.
#include "saca/runtime/read_tape.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "saca/base/formats/json_reader.h"
#include "saca/base/formats/json_text.h"
#include "saca/onboard/manoeuvre/drive.h"
#include "saca/runtime/tape_json.h"
#include "saca/thinking/memory/scene_json.h"

namespace saca::runtime {
namespace {

using formats::JsonReader;
using nlohmann::json;

/// The value of an enumeration of `count` that `name` gives this name.
template <class Enum, int count>
std::optional<Enum> named(std::string_view word) {
  for (int i = 0; i < count; ++i) {
    if (name(static_cast<Enum>(i)) == word) {
      return static_cast<Enum>(i);
    }
  }
  return std::nullopt;
}

std::optional<double> read_number(JsonReader& from, std::string_view key) {
  return from.has_value(key) ? std::optional(from.number(key)) : std::nullopt;
}

/// @return  nullopt where there is null
template <class Read>
auto read_optional(JsonReader& from, std::string_view key, Read&& read) {
  using T = decltype(read(from.object(key)));
  if (!from.has_value(key)) {
    return std::optional<T>();
  }
  return std::optional<T>(read(from.object(key)));
}

template <class T, std::size_t capacity, class Read>
void read_list(JsonReader& from, std::string_view key, StaticVector<T, capacity>& list,
               Read&& read) {
  const json* all = from.list(key, capacity);
  for (std::size_t i = 0; all != nullptr && i < all->size(); ++i) {
    list.push_back(read(from.element(key, *all, i)));
  }
}

manoeuvre::Plan read_plan(JsonReader from) {
  const manoeuvre::Plan plan{
      static_cast<manoeuvre::PolicyId>(from.integer("policy", manoeuvre::num_policies - 1)),
      read_number(from, "target_speed_mps"), read_number(from, "strength")};
  from.refuse_others();
  return plan;
}

reflex::JudgedPlan read_judged(JsonReader from) {
  const reflex::JudgedPlan judged{.plan = read_plan(from.object("plan")),
                                  .drivable = from.flag("drivable"),
                                  .harm = from.number("harm"),
                                  .contact = from.number("contact"),
                                  .as_seen = read_number(from, "harm_as_seen")};
  from.refuse_others();
  return judged;
}

/// All of a verdict but that no other key may be there.
reflex::Verdict read_verdict_keys(JsonReader& from) {
  reflex::Verdict verdict{.time = from.number("t_s")};
  read_list(from, "plans", verdict.plans, read_judged);
  verdict.later = read_number(from, "later");
  verdict.under_way = read_optional(from, "under_way", read_judged);
  return verdict;
}

reflex::Verdict read_verdict(JsonReader from) {
  const reflex::Verdict verdict = read_verdict_keys(from);
  from.refuse_others();
  return verdict;
}

NumberedVerdict read_numbered(JsonReader from) {
  const NumberedVerdict numbered{read_verdict_keys(from), from.integer("scene")};
  from.refuse_others();
  return numbered;
}

match::EgoFeatures read_ego_features(JsonReader from) {
  constexpr std::string_view beyonds = "unmarked, kerb, barrier or trees";
  match::EgoFeatures ego;
  ego.usable = from.flag("usable");
  ego.v_L = {from.number("along_mps"), from.number("across_mps")};
  ego.offset = from.number("offset_m");
  ego.heading = from.number("heading_rad");
  ego.yaw_rate = from.number("yaw_rate_radps");
  ego.length = from.number("length_m");
  ego.width = from.number("width_m");
  ego.log_grip = from.number("log_grip");
  ego.lane_width = from.number("lane_width_m");
  ego.curve = from.number("curve_mps2");
  ego.to_left_edge = from.number("room_left_m");
  ego.to_right_edge = from.number("room_right_m");
  ego.topology = from.word("topology", world::topology_from, "straight, intersection or one_way");
  ego.left_beyond = from.word("left_beyond", world::beyond_from, beyonds);
  ego.right_beyond = from.word("right_beyond", world::beyond_from, beyonds);
  ego.oncoming_left = from.flag("oncoming_left");
  ego.oncoming_right = from.flag("oncoming_right");
  from.refuse_others();
  return ego;
}

match::ActorFeatures read_actor_features(JsonReader from) {
  match::ActorFeatures actor;
  actor.p_rel_L = {from.number("ahead_m"), from.number("left_m")};
  actor.v_rel_L = {from.number("along_mps"), from.number("across_mps")};
  actor.sideways = from.number("sideways_mps2");
  actor.forward_L = {from.number("forward_s"), from.number("forward_d")};
  actor.length = from.number("length_m");
  actor.width = from.number("width_m");
  actor.threat = from.number("threat");
  actor.kind = from.word("kind", world::actor_kind_from, "a kind of road user or obstacle");
  from.refuse_others();
  return actor;
}

reflex::Source read_source(JsonReader& from) {
  return from.word("source", named<reflex::Source, 5>,
                   "fallback, memory, model, forced or arbiter");
}

std::int32_t read_preview(JsonReader& from) {
  return static_cast<std::int32_t>(
      from.integer("preview", std::numeric_limits<std::int32_t>::max()));
}

reflex::CachedPlan read_cached(JsonReader from) {
  reflex::CachedPlan cached;
  cached.at_trigger.ego = read_ego_features(from.object("ego"));
  read_list(from, "actors", cached.at_trigger.actors, read_actor_features);
  cached.trigger = from.number("trigger_s");
  cached.plan = read_plan(from.object("plan"));
  cached.source = read_source(from);
  cached.worse_than_aeb = from.flag("worse_than_aeb");
  cached.preview = read_preview(from);
  from.refuse_others();
  return cached;
}

reflex::Threat read_threat(JsonReader from) {
  const reflex::Threat threat{from.integer("actor", world::max_actors - 1), from.number("time_s")};
  from.refuse_others();
  return threat;
}

reflex::Switch read_switch(JsonReader from) {
  const reflex::Switch change{
      .plan = read_plan(from.object("plan")),
      .reason =
          from.word("reason", named<reflex::SwitchReason, 5>,
                    "needed after all, no longer needed, better by far, harder needed or cannot "
                    "be judged"),
      .harm = from.number("harm"),
      .harm_before = from.number("harm_before")};
  from.refuse_others();
  return change;
}

reflex::Reflex read_reflex(JsonReader from) {
  reflex::Reflex reflex;
  reflex.plan = read_plan(from.object("plan"));
  reflex.threat = read_optional(from, "threat", read_threat);
  reflex.triggered = from.flag("triggered");
  reflex.switched = read_optional(from, "switched", read_switch);
  reflex.refused_scene = from.flag("refused_scene");
  from.refuse_others();
  return reflex;
}

reflex::RefusedPlan read_refused(JsonReader from) {
  constexpr std::uint64_t last = static_cast<std::uint64_t>(manoeuvre::Refusal::strength);
  const reflex::RefusedPlan refused{read_plan(from.object("plan")),
                                    static_cast<manoeuvre::Refusal>(from.integer("why", last))};
  from.refuse_others();
  return refused;
}

reflex::Decision read_decision(JsonReader from) {
  reflex::Decision decision;
  decision.plan = read_plan(from.object("plan"));
  decision.source = read_source(from);
  decision.similarity = read_number(from, "similarity");
  if (from.has_value("preview")) {
    decision.preview = read_preview(from);
  }
  decision.not_admissible = from.flag("not_admissible");
  decision.verdict = read_optional(from, "verdict", read_verdict);
  decision.by_atlas = from.flag("by_atlas");
  decision.refused = read_optional(from, "refused", read_refused);
  decision.time = from.number("t_s");
  decision.waiting_cost = read_number(from, "waiting_cost");
  from.refuse_others();
  return decision;
}

void read_beliefs(JsonReader& from, intent::Beliefs& beliefs) {
  const json* all = from.list("beliefs", world::max_actors);
  for (std::size_t i = 0; all != nullptr && i < all->size(); ++i) {
    std::array<double, intent::num_horizons * intent::num_intentions> numbers{};
    from.numbers("beliefs", *all, i, numbers);
    intent::Belief belief;
    const double* next = numbers.data();
    for (intent::IntentPosterior& posterior : belief.at) {
      std::copy_n(next, posterior.size(), posterior.begin());
      next += posterior.size();
    }
    beliefs.push_back(belief);
  }
}

TapeStep read_step(JsonReader& from) {
  TapeStep step;
  step.number = from.integer("number");
  step.forgotten = from.word("forgotten", named<Reset, 3>, "nothing, encounter or drive");
  const bool usable = from.has_value("scene");
  if (usable) {
    const auto scene = memory::scene_from_json(from.any("scene"));
    if (scene.has_value()) {
      step.scene = scene.value();
    } else {
      from.reject("scene", scene.error().message);
    }
  }
  read_beliefs(from, step.beliefs);
  step.finished = from.flag("finished");
  if (from.has_value("plans")) {
    read_list(from, "plans", step.plans.emplace(), read_cached);
  }
  step.verdict = read_optional(from, "verdict", read_numbered);
  step.reflex = read_reflex(from.object("reflex"));
  step.decision = read_optional(from, "decision", read_decision);
  from.refuse_others();
  if (step.beliefs.size() != step.scene.actors.size()) {
    from.reject("beliefs", fmt::format("want one for each of the scene's {} actors, got {}",
                                       step.scene.actors.size(), step.beliefs.size()));
  }
  if (step.reflex.triggered != step.decision.has_value()) {
    from.reject("decision", "want one where the step triggers, and only there");
  }
  if (!usable && !step.reflex.refused_scene) {
    from.reject("scene", "want an object, got null");
  }
  return step;
}

void read_before(JsonReader& from, TapeContent& content) {
  content.dropped = from.integer("dropped");
  content.lost = from.integer("lost");
  read_list(from, "plans", content.plans, read_cached);
  content.verdict = read_optional(from, "verdict", read_verdict);
  from.refuse_others();
}

reflex::Thresholds read_thresholds(JsonReader from) {
  const reflex::Thresholds thresholds{.trigger = from.number("trigger_s"),
                                      .preview = from.number("preview_s"),
                                      .trigger_tolerance = from.number("trigger_tolerance_s"),
                                      .preview_tolerance = from.number("preview_tolerance_s"),
                                      .least_posterior = from.number("least_posterior"),
                                      .waiting_cost = read_number(from, "waiting_cost"),
                                      .earliest_swerve = from.number("earliest_swerve_s")};
  from.refuse_others();
  return thresholds;
}

ThinkingCosts read_costs(JsonReader from) {
  const ThinkingCosts costs{.preview = from.number("preview_s"),
                            .verdict = from.number("verdict_s"),
                            .prompt_token = from.number("prompt_token_s"),
                            .reply_token = from.number("reply_token_s")};
  from.refuse_others();
  return costs;
}

TapeHeader read_header(JsonReader& from) {
  constexpr std::uint64_t most_draws = 4'096;
  TapeHeader header;
  from.schema(tape_schema);
  header.program = from.text("program");
  header.level = from.text("level");
  header.car = from.text("car");
  header.car_digest = from.text("car_digest");
  header.intent_digest = from.text("intent_digest");
  header.harm_digest = from.text("harm_digest");
  if (from.has_value("atlas_digest")) {
    header.atlas = from.text("atlas_digest");
  }
  if (from.has_value("cues_digest")) {
    header.cues = from.text("cues_digest");
  }
  header.danger = from.flag("danger");
  header.model = from.text("model");
  header.memory = from.flag("memory");
  header.num_draws = from.integer("num_draws", most_draws);
  if (header.num_draws == 0) {
    from.reject("num_draws", "want at least 1, got 0");
  }
  header.guarded = from.flag("guarded");
  header.forced = read_optional(from, "forced", read_plan);
  header.thresholds = read_thresholds(from.object("thresholds"));
  header.pace = from.word("pace", named<Pace, 2>, "real or lockstep");
  header.costs = read_costs(from.object("costs"));
  header.scenario = from.text("scenario");
  if (from.has_value("seed")) {
    header.seed = from.integer("seed");
  }
  from.refuse_others();
  return header;
}

/// What a tape's line looks like in a message: printable, and short.
std::string shown(std::string_view line) {
  return JsonReader::shown(json(std::string(line.substr(0, 40))));
}

/// Line by line, what each says of itself in "type".
class TapeReader {
 public:
  explicit TapeReader(std::string_view source) : source_(source) {}

  Result<TapeFile> read(std::string_view text);

 private:
  [[nodiscard]] Error error(std::string_view what) const {
    return {Error::Code::malformed, line_ == 0 ? fmt::format("{}: {}", source_, what)
                                               : fmt::format("{}:{}: {}", source_, line_, what)};
  }
  std::optional<Error> read_line(std::string_view line);
  void read_object(JsonReader& from);
  void read_end(JsonReader& from);

  std::string_view source_;
  std::size_t line_ = 0;
  TapeFile tape_;
  Fnv hash_;
  bool ended_ = false;
};

Result<TapeFile> TapeReader::read(std::string_view text) {
  if (text.empty()) {
    return error("want a tape (saca.tape/6), got an empty file");
  }
  while (!text.empty()) {
    ++line_;
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    if (ended_) {
      return error("want nothing after the end of the tape, got " + shown(line));
    }
    if (auto problem = read_line(line)) {
      return *std::move(problem);
    }
    if (end == std::string_view::npos) {
      return error("want a line that ends, got the end of the file");
    }
    hash_.add(text.substr(0, end + 1));
    text.remove_prefix(end + 1);
  }
  if (!ended_) {
    return error(
        "want the line that ends a tape after it, got the end of the file: it is cut short");
  }
  return std::move(tape_);
}

std::optional<Error> TapeReader::read_line(std::string_view line) {
  const auto node = formats::parse_json(line);
  if (!node.has_value()) {
    return error("want one JSON object of a tape (saca.tape/6), got " + shown(line));
  }
  std::optional<Error> problem;
  JsonReader from(node.value(), "", problem, "line");
  read_object(from);
  return problem ? std::optional(error(problem->message)) : std::nullopt;
}

void TapeReader::read_object(JsonReader& from) {
  const std::string type = from.text("type");
  if (line_ <= 2) {
    const std::string_view wanted = line_ == 1 ? "header" : "before";
    if (type != wanted) {
      from.reject("type",
                  fmt::format("want \"{}\" of a tape (saca.tape/6), got {}", wanted, shown(type)));
    } else if (line_ == 1) {
      tape_.header = read_header(from);
    } else {
      read_before(from, tape_.content);
    }
    return;
  }
  std::vector<TapeStep>& steps = tape_.content.steps;
  if (type == "step") {
    steps.push_back(read_step(from));
    if (steps.size() > 1 && steps.back().number <= steps[steps.size() - 2].number) {
      from.reject("number", fmt::format("want more than {}, got {}", steps[steps.size() - 2].number,
                                        steps.back().number));
    }
  } else if (type == "end") {
    read_end(from);
  } else {
    from.reject("type", "want \"step\" or \"end\", got " + shown(type));
  }
}

void TapeReader::read_end(JsonReader& from) {
  ended_ = true;
  const std::uint64_t steps = from.integer("steps");
  const std::string digest = from.text("digest");
  from.refuse_others();
  if (steps != tape_.content.steps.size()) {
    from.reject("steps", fmt::format("want {}, as many as there are, got {}",
                                     tape_.content.steps.size(), steps));
  }
  if (digest != digest_text(hash_)) {
    from.reject("digest", fmt::format("want {}, that of the lines before, got {}: something in "
                                      "them was altered",
                                      digest_text(hash_), shown(digest)));
  }
}

}  // namespace

Result<TapeFile> read_tape(std::string_view text, std::string_view source) {
  return TapeReader(source).read(text);
}

}  // namespace saca::runtime
