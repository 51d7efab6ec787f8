#include "saca/lab/prepare/harm_file.h"

#include <string>

#include "saca/base/config/config.h"
#include "saca/base/core/file.h"
#include "saca/base/core/units.h"

namespace saca::prepare {
namespace {

using collision::HarmModel;
using config::Table;
using world::ActorKind;
using world::Beyond;

constexpr config::Range share_range{0.0, 1.0};
constexpr config::Range weight_range{0.0, 1000.0};
constexpr config::Range intercept_range{-30.0, 30.0};
constexpr config::Range slope_range{1e-6, 100.0};

std::size_t index(Beyond beyond) {
  return static_cast<std::size_t>(beyond);
}

collision::UnprotectedRisk unprotected_risk(Table root, std::string_view key) {
  Table table = root.table(key);
  // A slope per km/h is 3.6 times that per m/s.
  const double per_mps = to_kmh(1.0);
  collision::UnprotectedRisk risk;
  risk.severe.intercept = table.number("severe_intercept", intercept_range);
  risk.severe.slope = per_mps * table.number("severe_slope_per_kmh", slope_range);
  risk.killed.intercept = table.number("killed_intercept", intercept_range);
  risk.killed.slope = per_mps * table.number("killed_slope_per_kmh", slope_range);
  return risk;
}

void read_occupants(Table root, HarmModel& model) {
  Table weight = root.table("weight");
  model.severe_weight = weight.number("severe", weight_range);
  model.killed_weight = weight.number("killed", weight_range);
  Table occupant = root.table("occupant");
  model.occupant.intercept = occupant.number("intercept", intercept_range);
  model.occupant.slope = occupant.number("slope_per_mps", slope_range);
  model.side = occupant.number("side", intercept_range);
  model.rear = occupant.number("rear", intercept_range);
  model.killed_share = occupant.number("killed_share", share_range);
  Table people = root.table("people");
  model.ego_people = people.number("ego", weight_range);
  for (std::size_t i = 0; i < collision::num_actor_kinds; ++i) {
    model.people[i] = people.number(world::name(static_cast<ActorKind>(i)), weight_range);
  }
}

void read_contact(Table root, HarmModel& model) {
  Table contact = root.table("contact");
  model.law.restitution = contact.number("restitution", share_range);
  model.law.friction = contact.number("friction", {0.0, 10.0});
  model.depth = contact.number("depth_m", {1e-4, 1.0});
  Table beyond = root.table("beyond");
  model.speed_share[index(Beyond::barrier)] = 1.0;
  for (const Beyond kind : {Beyond::trees, Beyond::kerb, Beyond::unmarked}) {
    const std::string key = std::string(world::name(kind)) + "_speed_share";
    model.speed_share[index(kind)] = beyond.number(key, share_range);
  }
}

}  // namespace

Result<HarmModel> parse_harm(std::string_view text, std::string_view source) {
  const auto document = config::Document::parse(text, source);
  if (!document.has_value()) {
    return document.error();
  }
  const Table root = document.value().root();
  HarmModel model;
  read_occupants(root, model);
  model.pedestrian = unprotected_risk(root, "pedestrian");
  model.cyclist = unprotected_risk(root, "cyclist");
  model.motorcyclist = unprotected_risk(root, "motorcyclist");
  read_contact(root, model);
  if (const auto error = document.value().error()) {
    return *error;
  }
  return model;
}

Result<HarmModel> read_harm(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text.has_value()) {
    return text.error();
  }
  return parse_harm(text.value(), path.string());
}

}  // namespace saca::prepare
