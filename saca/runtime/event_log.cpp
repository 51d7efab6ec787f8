#include "saca/runtime/event_log.h"

#include <fmt/core.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "saca/base/core/names.h"

namespace saca::runtime {
namespace {

using arbitration::Event;
using arbitration::EventKind;
using arbitration::Plane;

constexpr std::array<std::string_view, 5> remark_texts{
    "the encounter is over: the stack drives",
    "the scenes' time jumped: a new drive begins, what was known is forgotten",
    "perception: somebody or everything is carried on instead of seen",
    "perception: there is no scene to decide by",
    "perception: everybody is seen again",
};

EventKind kind_of(Remark remark) {
  return remark == Remark::encounter_over ? EventKind::rest : EventKind::fault;
}

}  // namespace

EventLog::EventLog(std::size_t capacity) : notices_(capacity), thoughts_(capacity) {}

void EventLog::triggered(const reflex::Decision& decision, const world::Actor& by,
                         double left) noexcept {
  notices_.push({decision.time, TriggerEntry{decision, by, left}});
}

void EventLog::switched(double time, const reflex::Switch& change) noexcept {
  notices_.push({time, change});
}

void EventLog::remark(double time, Remark remark) noexcept {
  notices_.push({time, remark});
}

void EventLog::thought(Event event) noexcept {
  thoughts_.push(std::move(event));
}

std::optional<Event> EventLog::next() {
  if (read_.empty()) {
    if (const auto notice = notices_.pop()) {
      add_events_of(*notice);
    } else if (auto event = thoughts_.pop()) {
      read_.push_back(*std::move(event));
    }
  }
  if (read_.empty()) {
    const auto of_driving =
        rejected(Plane::reflex, notices_.num_rejected(), notices_rejected_told_);
    return of_driving
               ? of_driving
               : rejected(Plane::thinking, thoughts_.num_rejected(), thoughts_rejected_told_);
  }
  Event event = std::move(read_.front());
  read_.pop_front();
  time_ = event.time;
  return event;
}

void EventLog::add_events_of(const Notice& notice) {
  const auto add = [&](EventKind kind, std::string text) {
    read_.push_back({notice.time, Plane::reflex, kind, std::move(text)});
  };
  if (const auto* const remark = std::get_if<Remark>(&notice.what)) {
    add(kind_of(*remark), std::string(name_of(*remark, remark_texts)));
  } else if (const auto* const change = std::get_if<reflex::Switch>(&notice.what)) {
    add(EventKind::switched,
        fmt::format("{}: {}", name(change->reason), arbitration::switch_text(*change)));
  } else {
    const auto& trigger = std::get<TriggerEntry>(notice.what);
    add(EventKind::trigger,
        arbitration::trigger_text(trigger.by, trigger.left, trigger.decision.waiting_cost));
    add(trigger.decision.refused ? EventKind::fault : EventKind::match,
        arbitration::decision_text(trigger.decision));
    add(EventKind::execute,
        arbitration::execution_text(trigger.decision.plan, trigger.decision.source));
  }
}

std::optional<Event> EventLog::rejected(Plane plane, std::size_t count, std::size_t& told) const {
  const std::size_t num_new = count - std::exchange(told, count);
  return num_new == 0 ? std::nullopt
                      : std::optional(arbitration::events_not_told(time_, plane, num_new));
}

}  // namespace saca::runtime
