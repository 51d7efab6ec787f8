#include "saca/lab/crash_records/roles.h"

#include <algorithm>
#include <array>
#include <initializer_list>

#include "saca/base/core/names.h"

namespace saca::crash_records {
namespace {

using collision::Face;
using families::FamilyKind;

enum class From : std::uint8_t { unknown, left, right };

/// The ego's crash type, that of the other one, and what both say. Source: the diagrams of the
/// manual, appendix on crash types.
struct TypeRole {
  int ego;
  std::array<int, 3> other;  ///< 0: none
  CrashFamily family;
  FamilyKind kind;
  From from;
  std::optional<Face> struck;
};

constexpr std::optional<Face> any_face = std::nullopt;

// In order: what comes first is preferred where a record has several.
constexpr std::array<TypeRole, 18> type_roles{{
    {20, {21, 22, 23}, CrashFamily::rear_end, FamilyKind::slower_lead, From::unknown, Face::front},
    {24, {25, 26, 27}, CrashFamily::rear_end, FamilyKind::slower_lead, From::unknown, Face::front},
    {28, {29, 30, 31}, CrashFamily::rear_end, FamilyKind::lead_brakes, From::unknown, Face::front},
    {45, {46, 0, 0}, CrashFamily::lane_change, FamilyKind::sideswipe, From::left, any_face},
    {45, {47, 0, 0}, CrashFamily::lane_change, FamilyKind::sideswipe, From::right, any_face},
    {44, {46, 0, 0}, CrashFamily::lane_change, FamilyKind::sideswipe, From::left, any_face},
    {44, {47, 0, 0}, CrashFamily::lane_change, FamilyKind::sideswipe, From::right, any_face},
    {51, {50, 0, 0}, CrashFamily::head_on, FamilyKind::head_on, From::left, Face::front},
    {65, {64, 0, 0}, CrashFamily::head_on, FamilyKind::head_on, From::left, any_face},
    {52, {52, 0, 0}, CrashFamily::head_on, FamilyKind::head_on, From::left, any_face},
    {69, {68, 0, 0}, CrashFamily::turning, FamilyKind::turning, From::left, any_face},
    {83, {82, 0, 0}, CrashFamily::turning, FamilyKind::turning, From::right, any_face},
    {77, {76, 0, 0}, CrashFamily::turning, FamilyKind::turning, From::left, any_face},
    {79, {78, 0, 0}, CrashFamily::turning, FamilyKind::turning, From::right, any_face},
    {86, {87, 0, 0}, CrashFamily::crossing, FamilyKind::crossing, From::left, Face::front},
    {87, {86, 0, 0}, CrashFamily::crossing, FamilyKind::crossing, From::right, Face::right},
    {88, {89, 0, 0}, CrashFamily::crossing, FamilyKind::crossing, From::right, Face::front},
    {89, {88, 0, 0}, CrashFamily::crossing, FamilyKind::crossing, From::left, Face::left},
}};

constexpr std::array<std::string_view, num_crash_families> family_names{
    "rear_end", "lane_change", "head_on", "crossing", "turning", "pedestrian", "cyclist", "ramp"};
constexpr std::array<std::string_view, 4> place_names{"ramp", "junction", "highway", "road"};
constexpr std::array<std::string_view, 3> why_names{"type_not_covered", "ego_is_no_car",
                                                    "other_unknown"};

bool is_one_of(const Code& code, std::initializer_list<int> codes) {
  return code && std::find(codes.begin(), codes.end(), *code) != codes.end();
}

/// Critical event: somebody else was in the lane or came into it.
bool was_others_doing(const FarsVehicle& vehicle) {
  return vehicle.event && *vehicle.event >= 50 && *vehicle.event <= 78;
}

bool is_on_ramp(const FarsCrash& crash) {
  return is_one_of(crash.junction, {5, 17, 20}) ||
         std::any_of(crash.vehicles.begin(), crash.vehicles.end(),
                     [](const FarsVehicle& one) { return is_one_of(one.trafficway, {6}); });
}

Place place_of(const FarsCrash& crash, const Roles& roles) {
  if (is_on_ramp(crash)) {
    return Place::ramp;
  }
  const bool is_of_junctions =
      roles.family == CrashFamily::crossing || roles.family == CrashFamily::turning;
  if (crash.junction ? is_one_of(crash.junction, {2, 3, 4, 8}) : is_of_junctions) {
    return Place::junction;
  }
  constexpr int least_of_highways = 55;  // [mph]
  const Code& limit = crash.vehicles[roles.ego].speed_limit;
  return limit && *limit >= least_of_highways ? Place::highway : Place::road;
}

bool is_car(const FarsVehicle& vehicle, const FarsCodes& codes) {
  const auto kind = codes.kind_of_body(vehicle.body);
  return kind == world::ActorKind::car || kind == world::ActorKind::van;
}

/// The first vehicle other than `ego` with one of the types.
std::optional<std::size_t> partner(const FarsCrash& crash, std::size_t ego,
                                   const std::array<int, 3>& types) {
  for (std::size_t i = 0; i < crash.vehicles.size(); ++i) {
    const Code& type = crash.vehicles[i].crash_type;
    if (i != ego && type && *type != 0 &&
        std::find(types.begin(), types.end(), *type) != types.end()) {
      return i;
    }
  }
  return std::nullopt;
}

/// Of several that could be the ego: a car whom another got in the way of, else a car, else
/// anybody.
int preference(const FarsVehicle& vehicle, const FarsCodes& codes) {
  return (is_car(vehicle, codes) ? 2 : 0) + (was_others_doing(vehicle) ? 1 : 0);
}

struct Pair {
  const TypeRole* type = nullptr;
  std::size_t ego = 0;
  std::optional<std::size_t> other;
};

/// Everybody who could be the ego of a crash between vehicles.
std::vector<Pair> pairs_of(const FarsCrash& crash) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < crash.vehicles.size(); ++i) {
    const FarsVehicle& vehicle = crash.vehicles[i];
    std::optional<Pair> found;
    for (const TypeRole& role : type_roles) {
      if (vehicle.crash_type != role.ego ||
          (role.ego == 52 && !is_one_of(vehicle.event, {54, 62, 63}))) {
        continue;
      }
      const auto other = partner(crash, i, role.other);
      if (!found || (!found->other && other)) {
        found = Pair{&role, i, other};
      }
    }
    if (found) {
      pairs.push_back(*found);
    }
  }
  return pairs;
}

struct Struck {
  std::size_t ego = 0;
  std::size_t person = 0;
  CrashFamily family = CrashFamily::pedestrian;
};

/// The first person outside a vehicle and who ran into him; nullopt: it was no such crash.
std::optional<Struck> struck_in(const FarsCrash& crash) {
  constexpr int pedestrian_or_animal = 13;
  for (std::size_t p = 0; p < crash.persons.size(); ++p) {
    const FarsPerson& person = crash.persons[p];
    const bool walks = is_one_of(person.type, {5, 8});
    if (!person.struck_by || !(walks || is_one_of(person.type, {6, 7}))) {
      continue;
    }
    for (std::size_t v = 0; v < crash.vehicles.size(); ++v) {
      const FarsVehicle& vehicle = crash.vehicles[v];
      const bool of_people = vehicle.event && *vehicle.event >= 80 && *vehicle.event <= 85;
      if (vehicle.number == *person.struck_by && vehicle.crash_type == pedestrian_or_animal &&
          of_people) {
        return Struck{v, p, walks ? CrashFamily::pedestrian : CrashFamily::cyclist};
      }
    }
  }
  return std::nullopt;
}

Roles with_place(const FarsCrash& crash, Roles roles) {
  roles.place = place_of(crash, roles);
  if (roles.place == Place::ramp) {
    roles.family = CrashFamily::ramp;
  }
  return roles;
}

}  // namespace

std::string_view name(CrashFamily family) {
  return name_of(family, family_names);
}
std::optional<CrashFamily> crash_family_from(std::string_view name) {
  return value_from<CrashFamily>(name, family_names);
}
std::string_view name(Place place) {
  return name_of(place, place_names);
}
std::string_view name(NoRoles why) {
  return name_of(why, why_names);
}

std::variant<Roles, NoRoles> roles_of(const FarsCrash& crash, const FarsCodes& codes) {
  if (const auto struck = struck_in(crash)) {
    if (!is_car(crash.vehicles[struck->ego], codes)) {
      return NoRoles::ego_is_no_car;
    }
    return with_place(crash,
                      {.family = struck->family,
                       .kind = struck->family == CrashFamily::pedestrian ? FamilyKind::pedestrian
                                                                         : FamilyKind::cyclist,
                       .ego = struck->ego,
                       .other = std::nullopt,
                       .person = struck->person,
                       .from_left = std::nullopt,
                       .struck = std::nullopt});
  }
  std::vector<Pair> pairs = pairs_of(crash);
  if (pairs.empty()) {
    return NoRoles::type_not_covered;
  }
  std::stable_sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) {
    return preference(crash.vehicles[a.ego], codes) > preference(crash.vehicles[b.ego], codes);
  });
  const Pair& best = pairs.front();
  if (!is_car(crash.vehicles[best.ego], codes)) {
    return NoRoles::ego_is_no_car;
  }
  if (!best.other || !codes.kind_of_body(crash.vehicles[*best.other].body)) {
    return NoRoles::other_unknown;
  }
  const TypeRole& type = *best.type;
  return with_place(
      crash, {.family = type.family,
              .kind = type.kind,
              .ego = best.ego,
              .other = best.other,
              .person = std::nullopt,
              .from_left = type.from == From::unknown ? std::nullopt
                                                      : std::optional(type.from == From::left),
              .struck = type.struck});
}

std::optional<CrashFamily> crash_family_of(const FarsCrash& crash) {
  const auto struck = struck_in(crash);
  const std::vector<Pair> pairs = pairs_of(crash);
  if (!struck && pairs.empty()) {
    return std::nullopt;
  }
  return is_on_ramp(crash) ? CrashFamily::ramp
                           : (struck ? struck->family : pairs.front().type->family);
}

std::optional<collision::Face> face_of_impact(const Code& impact) {
  // Clock positions, and from 61 and 81 on the parts of the left and of the right side.
  if (is_one_of(impact, {11, 12, 1})) {
    return Face::front;
  }
  if (is_one_of(impact, {2, 3, 4, 81, 82, 83})) {
    return Face::right;
  }
  if (is_one_of(impact, {5, 6, 7})) {
    return Face::rear;
  }
  return is_one_of(impact, {8, 9, 10, 61, 62, 63}) ? std::optional(Face::left) : std::nullopt;
}

}  // namespace saca::crash_records
