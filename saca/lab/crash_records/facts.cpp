#include "saca/lab/crash_records/facts.h"

#include <fmt/core.h>

#include <string_view>

namespace saca::crash_records {
namespace {

/// Columns whose code is a number of something.
std::string counted(const Code& code, std::string_view unit) {
  return code ? fmt::format("{} {}", *code, unit) : std::string("not known");
}

std::string words_of_impact(const Code& impact) {
  const auto face = face_of_impact(impact);
  return face ? std::string(collision::name(*face)) : impact ? "elsewhere" : "not known";
}

void add_vehicle(std::vector<Fact>& facts, const char* about, const FarsVehicle& vehicle,
                 const FarsCodes& codes) {
  const auto add = [&](const char* key, const Code& code) {
    facts.push_back({about, key, code, codes.meaning(key, code)});
  };
  facts.push_back({about, "VEH_NO", vehicle.number, fmt::format("vehicle {}", vehicle.number)});
  add("ACC_TYPE", vehicle.crash_type);
  add("BODY_TYP", vehicle.body);
  add("P_CRASH1", vehicle.manoeuvre);
  add("P_CRASH2", vehicle.event);
  add("P_CRASH3", vehicle.avoidance);
  facts.push_back({about, "TRAV_SP", vehicle.travel_speed, counted(vehicle.travel_speed, "mph")});
  facts.push_back({about, "VSPD_LIM", vehicle.speed_limit, counted(vehicle.speed_limit, "mph")});
  add("VTRAFWAY", vehicle.trafficway);
  facts.push_back({about, "VNUM_LAN", vehicle.lanes, counted(vehicle.lanes, "lanes")});
  add("VALIGN", vehicle.alignment);
  add("VSURCOND", vehicle.surface);
  facts.push_back({about, "IMPACT1", vehicle.impact, words_of_impact(vehicle.impact)});
}

}  // namespace

std::vector<Fact> facts_of(const FarsCrash& crash, const Roles& roles, const FarsCodes& codes) {
  constexpr std::size_t most = 40;
  std::vector<Fact> facts;
  facts.reserve(most);
  const auto vehicles = static_cast<int>(crash.vehicles.size());
  facts.push_back({"crash", "VE_FORMS", vehicles, counted(vehicles, "vehicles")});
  facts.push_back({"crash", "LGT_COND", crash.light, codes.meaning("LGT_COND", crash.light)});
  facts.push_back({"crash", "RELJCT2", crash.junction, codes.meaning("RELJCT2", crash.junction)});
  add_vehicle(facts, "ego", crash.vehicles[roles.ego], codes);
  if (roles.other) {
    add_vehicle(facts, "other", crash.vehicles[*roles.other], codes);
  }
  if (roles.person) {
    const FarsPerson& person = crash.persons[*roles.person];
    facts.push_back({"person", "PER_TYP", person.type, codes.meaning("PER_TYP", person.type)});
    facts.push_back({"person", "AGE", person.age, counted(person.age, "years")});
    facts.push_back(
        {"person", "LOCATION", person.location, codes.meaning("LOCATION", person.location)});
  }
  return facts;
}

}  // namespace saca::crash_records
