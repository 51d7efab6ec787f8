#include "saca/decide/event.h"

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

}  // namespace saca::decide
