#include "saca/runtime/replay.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "saca/runtime/tape_json.h"
#include "saca/thinking/arbitration/forecaster.h"

namespace saca::runtime {
namespace {

using nlohmann::json;

/// "/plans/3/harm" as "plans[3].harm".
std::string key_of(const std::string& pointer) {
  std::string key;
  std::size_t at = 0;
  while (at < pointer.size()) {
    const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
    const std::string part = pointer.substr(at + 1, end - at - 1);
    const bool is_index = part.find_first_not_of("0123456789") == std::string::npos;
    key += is_index ? "[" + part + "]" : "." + part;
    at = end;
  }
  return key;
}

/// The value at a pointer, or null where there is none.
std::string at(const json& document, const std::string& pointer) {
  const json::json_pointer where(pointer);
  return document.contains(where) ? document[where].dump() : "null";
}

class Player {
 public:
  Player(const TapeContent& tape, const PlanesSetup& setup, const intent::Model& intent,
         std::size_t num_draws)
      : tape_(tape),
        intent_(intent),
        observer_(intent),
        forecaster_(setup.forecast, num_draws),
        reflex_(reflex_tools(setup)) {}

  Replay play();

 private:
  void observe(const TapeStep& step);
  void judge(const TapeStep& step);
  void answer(const TapeStep& step);
  void compare(const TapeStep& step, const char* what, const json& recorded, const json& got,
               Reproduction& of);

  const TapeContent& tape_;
  const intent::Model& intent_;
  intent::Observer observer_;
  arbitration::Forecaster forecaster_;
  reflex::ReflexPlane reflex_;
  bool is_observed_ = false;  ///< without a gap from where the observer began
  std::optional<std::uint64_t> last_;
  std::optional<reflex::UnderWay> under_way_;                  ///< as recorded
  std::vector<std::optional<reflex::UnderWay>> under_way_at_;  ///< of the steps so far
  Replay replay_;
};

Replay Player::play() {
  reflex_.receive(tape_.plans);
  if (tape_.verdict) {
    reflex_.receive(*tape_.verdict);
  }
  for (const TapeStep& step : tape_.steps) {
    if (step.forgotten != Reset::nothing) {
      reflex_.begin_anew();
      under_way_.reset();
    }
    under_way_at_.push_back(under_way_);
    if (!step.reflex.refused_scene) {
      observe(step);
    }
    judge(step);
    answer(step);
    last_ = step.number;
  }
  return replay_;
}

void Player::observe(const TapeStep& step) {
  const bool follows = last_ && *last_ + 1 == step.number;
  if (step.forgotten == Reset::drive) {
    observer_ = intent::Observer(intent_);
    is_observed_ = true;
  } else if (!follows) {
    is_observed_ = false;
  }
  if (!is_observed_) {
    ++replay_.beliefs_not_compared;
    return;
  }
  compare(step, "beliefs", beliefs_json(step.beliefs), beliefs_json(observer_.look(step.scene)),
          replay_.beliefs);
}

void Player::judge(const TapeStep& step) {
  if (!step.verdict) {
    return;
  }
  const auto judged = std::lower_bound(
      tape_.steps.begin(), tape_.steps.end(), step.verdict->scene,
      [](const TapeStep& one, std::uint64_t number) { return one.number < number; });
  if (judged == tape_.steps.end() || judged->number != step.verdict->scene ||
      judged->number > step.number) {
    ++replay_.verdicts_not_compared;
    return;
  }
  const auto i = static_cast<std::size_t>(judged - tape_.steps.begin());
  compare(step, "verdict", verdict_json(step.verdict->verdict),
          verdict_json(forecaster_.judge(judged->scene, judged->beliefs, under_way_at_[i])),
          replay_.verdicts);
}

void Player::answer(const TapeStep& step) {
  if (step.plans) {
    reflex_.receive(*step.plans);
  }
  if (step.verdict) {
    reflex_.receive(step.verdict->verdict);
  }
  if (step.reflex.refused_scene) {
    return;
  }
  const reflex::Reflex reflex = reflex_.step(step.scene, step.finished);
  if (step.decision || reflex.triggered) {
    compare(step, "decision", step.decision ? decision_json(*step.decision) : json(nullptr),
            reflex.triggered ? decision_json(*reflex_.decision()) : json(nullptr),
            replay_.decisions);
  }
  if (step.reflex.switched || reflex.switched) {
    const auto json_of = [](const std::optional<reflex::Switch>& change) {
      return change ? switch_json(*change) : json(nullptr);
    };
    compare(step, "switch", json_of(step.reflex.switched), json_of(reflex.switched),
            replay_.switches);
  }
  compare(step, "answer", reflex_json(step.reflex), reflex_json(reflex), replay_.answers);
  if (step.reflex.triggered || step.reflex.switched) {
    under_way_ = reflex::UnderWay{.plan = step.reflex.plan,
                                  .begun = step.scene.time,
                                  .ego = step.scene.ego,
                                  .road = step.scene.road,
                                  .grip = step.scene.grip};
  }
}

void Player::compare(const TapeStep& step, const char* what, const json& recorded, const json& got,
                     Reproduction& of) {
  ++of.recorded;
  // By their texts, in which numbers have all their digits: -0 and 0 are not the same.
  if (recorded.dump() == got.dump()) {
    ++of.same;
    return;
  }
  if (replay_.first) {
    return;
  }
  const json changes = json::diff(recorded, got);
  const std::string pointer = changes.empty() ? "" : changes[0]["path"].get<std::string>();
  replay_.first = Difference{.scene = step.number,
                             .time = step.scene.time,
                             .what = what + key_of(pointer),
                             .recorded = at(recorded, pointer),
                             .got = at(got, pointer)};
}

}  // namespace

Replay replay(const TapeContent& tape, const PlanesSetup& setup, const intent::Model& intent,
              std::size_t num_draws) {
  return Player(tape, setup, intent, num_draws).play();
}

}  // namespace saca::runtime
