#include "saca/lab/eval/scenario_axis.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "saca/base/config/toml_number.h"
#include "saca/base/core/csv.h"
#include "saca/base/core/short_number.h"

namespace saca::eval {
namespace {

using scenario::Scenario;
using scenario::ScenarioActor;

constexpr std::size_t most_values = 400;

std::string wanted_bodies(const Scenario& scenario) {
  std::string names = "grip, ego";
  for (const ScenarioActor& actor : scenario.actors) {
    names += ", " + actor_name(actor);
  }
  return names;
}

Error malformed(std::string_view text, const std::string& wanted) {
  return {Error::Code::malformed, fmt::format("{}: want {}", text, wanted)};
}

bool is_key(std::string_view body, std::string_view key) {
  return key == "speed_mps" || key == "offset_m" || (body != "ego" && key == "distance_m");
}

/// Of a text like "actors.0.start.s_m": which actor is meant, by name or by place, and how many
/// parts say so.
struct NamedActor {
  std::size_t actor;
  std::size_t num_parts;
};
std::optional<NamedActor> named_actor(const Scenario& scenario,
                                      const std::vector<std::string_view>& parts) {
  if (const auto actor = actor_called(scenario, parts[0])) {
    return NamedActor{*actor, 1};
  }
  if (parts[0] == "actors" && parts.size() > 1) {
    const auto place = finite_number(parts[1]);
    for (std::size_t i = 0; place && i < scenario.actors.size(); ++i) {
      if (static_cast<double>(i) == *place) {
        return NamedActor{i, 2};
      }
    }
  }
  return std::nullopt;
}

std::string joined(const std::vector<std::string_view>& parts, std::size_t from) {
  std::string text;
  for (std::size_t i = from; i < parts.size(); ++i) {
    text.append(".").append(parts[i]);
  }
  return text;
}

/// The last part that is no place in a list: what the number is, and its unit.
std::string key_of(const std::vector<std::string_view>& parts) {
  const auto key = std::find_if(parts.rbegin(), parts.rend(),
                                [](std::string_view part) { return !finite_number(part); });
  return key == parts.rend() ? "" : std::string(*key);
}

/// Which number of the file is meant; nullopt: none that is there. What stands deeper, or in a
/// table that may be missing, is left to the file's reader, who knows what there may be.
/// @param parts  of the text before "=", at least one
std::optional<Axis> number_of_file(const Scenario& scenario,
                                   const std::vector<std::string_view>& parts) {
  constexpr std::array<std::string_view, 4> tables{"road", "ego", "perception", "provenance"};
  const std::string file = scenario::write_scenario(scenario);
  const auto actor = named_actor(scenario, parts);
  const std::size_t rest = actor ? actor->num_parts : 1;
  const std::string head = actor ? fmt::format("actors.{}", actor->actor) : std::string(parts[0]);
  const std::string path = head + joined(parts, rest);
  const std::string in_start = head + ".start" + joined(parts, rest);
  const bool is_there = config::number_at(file, path).has_value();
  const bool of_body = actor || parts[0] == "ego";
  const bool of_table = std::find(tables.begin(), tables.end(), parts[0]) != tables.end();
  const bool left_to_reader = of_body ? parts.size() > rest + 1 : of_table && parts.size() > rest;
  Axis axis{
      .what = (actor ? actor_name(scenario.actors[actor->actor]) : head) + joined(parts, rest),
      .body = "",
      .key = key_of(parts),
      .path = path,
      .values = {}};
  if (!is_there && of_body && config::number_at(file, in_start)) {
    axis.path = in_start;
    return axis;
  }
  return is_there || left_to_reader ? std::optional(axis) : std::nullopt;
}

/// Which number a text before "=" names; an error whose message is what was wanted.
Result<Axis> named_number(std::string_view text, const Scenario& scenario) {
  const std::vector<std::string_view> parts = fields_of(text, '.');
  const auto actor = named_actor(scenario, parts);
  const std::size_t rest = actor ? actor->num_parts : 1;
  const std::string body =
      actor ? actor_name(scenario.actors[actor->actor]) : std::string(parts[0]);
  if (text == "grip") {
    return Axis{.what = "grip", .body = "", .key = "grip", .path = "", .values = {}};
  }
  const bool of_body = actor || body == "ego";
  const std::string key(parts.back());
  if (of_body && parts.size() == rest + 1 && is_key(body, key)) {
    return Axis{.what = body + "." + key, .body = body, .key = key, .path = "", .values = {}};
  }
  if (const auto of_file = number_of_file(scenario, parts)) {
    return *of_file;
  }
  const std::string among = of_body ? (body == "ego" ? "speed_mps or offset_m of the ego"
                                                     : "distance_m, offset_m or speed_mps")
                                    : "one of " + wanted_bodies(scenario);
  return Error{Error::Code::malformed,
               fmt::format("{}, or a number of the scenario's file, e.g. road.left_edge_m, got "
                           "\"{}\"",
                           among, of_body ? key : body)};
}

}  // namespace

std::optional<std::size_t> actor_called(const Scenario& scenario, std::string_view called) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < scenario.actors.size(); ++i) {
    const ScenarioActor& actor = scenario.actors[i];
    if (actor_name(actor) == called) {
      return i;
    }
    if (world::name(actor.kind) == called) {
      if (found) {
        return std::nullopt;
      }
      found = i;
    }
  }
  return found;
}

Result<Axis> parse_axis(std::string_view text, const Scenario& scenario) {
  const std::vector<std::string_view> sides = fields_of(text, '=');
  const std::string form = "BODY.KEY=FROM:TO:STEP or grip=FROM:TO:STEP, e.g. ego.speed_mps=8:18:1";
  if (sides.size() != 2) {
    return malformed(text, form);
  }
  const auto named = named_number(sides[0], scenario);
  if (!named.has_value()) {
    return malformed(text, named.error().message);
  }
  Axis axis = named.value();
  const std::vector<std::string_view> numbers = fields_of(sides[1], ':');
  std::vector<double> range;
  range.reserve(numbers.size());
  for (const std::string_view number : numbers) {
    range.push_back(finite_number(number).value_or(NAN));
  }
  if (range.size() != 3 || !(range[2] > 0.0) || !(range[1] >= range[0])) {
    return malformed(
        text, "FROM:TO:STEP with TO >= FROM and STEP > 0, got \"" + std::string(sides[1]) + "\"");
  }
  const double count = std::floor((range[1] - range[0]) / range[2] + 1e-9) + 1.0;
  if (count > static_cast<double>(most_values)) {
    return malformed(text, fmt::format("at most {} values, got {:.0f}", most_values, count));
  }
  for (int k = 0; k < static_cast<int>(count); ++k) {
    axis.values.push_back(short_number(range[0] + k * range[2]));
  }
  return axis;
}

}  // namespace saca::eval
