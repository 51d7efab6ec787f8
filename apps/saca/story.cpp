#include "apps/saca/story.h"

#include <fmt/core.h>

#include "saca/outcome/describe.h"

namespace saca::app {
namespace {

constexpr const char* plain = "\033[0m";

const char* colour_of(decide::EventKind kind) {
  using decide::EventKind;
  switch (kind) {
    case EventKind::trigger:
    case EventKind::match:
    case EventKind::execute:
      return "\033[1m";
    case EventKind::contact:
    case EventKind::fault:
      return "\033[31m";
    case EventKind::cached:
    case EventKind::rest:
      return "\033[32m";
    default:
      return "";
  }
}

}  // namespace

void Story::on_event(const decide::Event& event) {
  const std::lock_guard guard(lock_);
  fmt::print(stream_, "{}{:7.2f} s  {:8}  {}{}\n", colour_ ? colour_of(event.kind) : "", event.time,
             name(event.plane), event.text, colour_ ? plain : "");
  std::fflush(stream_);
}

void Story::on_reasoning(std::int32_t, std::string_view) {
  // Three replies grow together; the report has them in full.
}

void Story::headline(const sim::Scenario& scenario, const loop::Setup& setup) {
  const std::lock_guard guard(lock_);
  fmt::print(stream_, "{}\n{}\nPace {}, grip {:.2f}, language model: {}, forecasts: {}.\n\n",
             scenario.title, scenario.source, name(setup.pace), scenario.grip,
             setup.model == nullptr ? "off" : setup.model->description(),
             setup.atlas == nullptr ? "rolled out" : "from the atlas");
}

void Story::ending(const sim::Scenario& scenario, const loop::Record& record) {
  const std::lock_guard guard(lock_);
  fmt::print(stream_, "\n");
  if (!scenario.driver.empty()) {
    fmt::print(stream_, "The driver: {}\n", scenario.driver);
  }
  if (record.driver) {
    fmt::print(stream_, "The drive as recorded: {}.\n",
               outcome::describe(*record.driver, record.met_by_driver));
  }
  if (!record.decision) {
    fmt::print(stream_, "SACA: never triggered; {}.\n",
               outcome::describe(record.result, record.met));
    return;
  }
  const manoeuvre::PolicyId chosen = record.decision->plan.policy;
  fmt::print(stream_, "SACA: {} {}, {}. Collision Loss {:.2f}, harm {:.4f}.\n",
             manoeuvre::index(chosen), name(chosen), outcome::describe(record.result, record.met),
             record.result.collision_loss, record.result.harm);
  const preview::PolicyFacts& best = (*record.hindsight)[manoeuvre::index(*record.best)].facts;
  fmt::print(stream_, "Best in hindsight: {} {}, {}{}.\n", manoeuvre::index(*record.best),
             name(*record.best), outcome::describe(best.outcome, *record.at_trigger),
             *record.best == chosen ? ": the same" : "");
}

void Story::on_review(std::string_view text) {
  const std::lock_guard guard(lock_);
  if (!reviewing_) {
    fmt::print(stream_, "\nThe language model looks back:\n");
    reviewing_ = true;
  }
  fmt::print(stream_, "{}", text);
  std::fflush(stream_);
}

}  // namespace saca::app
