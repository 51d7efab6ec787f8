#include "saca/decide/event.h"

#include <fmt/core.h>

#include <array>

#include "saca/core/names.h"

namespace saca::decide {
namespace {

constexpr std::array<std::string_view, 3> plane_names{"world", "reflex", "thinking"};
constexpr std::array<std::string_view, 16> kind_names{
    "preview", "risk",   "intention", "forecast", "memory",  "ask",     "first_answer", "answer",
    "check",   "cached", "trigger",   "match",    "execute", "contact", "rest",         "fault"};

}  // namespace

std::string_view name(Plane plane) {
  return name_of(plane, plane_names);
}

std::string_view name(EventKind kind) {
  return name_of(kind, kind_names);
}

std::string decision_text(const Decision& decision) {
  if (decision.source == Source::forced) {
    return "asked for by the user";
  }
  if (!decision.similarity) {
    return "no plan is cached: emergency braking";
  }
  std::string text = fmt::format("the scene is {:.0f} % like forecast {}",
                                 100.0 * *decision.similarity, *decision.preview + 1);
  if (decision.source != Source::fallback) {
    return text + fmt::format(": its plan, from {}, is taken", name(decision.source));
  }
  if (!decision.gave_way_to_aeb) {
    return text + ", not more than 90 %: emergency braking";
  }
  return text +
         (decision.forecast
              ? fmt::format(", whose plan would do more harm from here than emergency braking: "
                            "{:.4f} against {:.4f}",
                            decision.forecast->plan, decision.forecast->aeb)
              : ", whose plan is now forecast to be no better than emergency braking");
}

}  // namespace saca::decide
