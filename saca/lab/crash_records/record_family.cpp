#include "saca/lab/crash_records/record_family.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "saca/base/core/units.h"
#include "saca/lab/crash_records/recorded_speed.h"
#include "saca/lab/families/family_stage.h"

namespace saca::crash_records {
namespace {

using families::FamilyKind;
using world::ActorKind;

constexpr double slowest_ego = 2.3;   // [m/s]: at less a crash is one of manoeuvring
constexpr double fastest_ego = 40.0;  // [m/s]: families end there
constexpr double fastest_other = 60.0;
constexpr double least_closing =
    4.0;  // [m/s], of a rear-end crash: as families::slower_lead has it

/// Puts a record's family together.
class Making {
 public:
  Making(const FarsCrash& crash, const Roles& roles, const FarsCodes& codes,
         families::Family family)
      : crash_(crash), roles_(roles), codes_(codes), family_(std::move(family)) {}

  Result<families::Family> made();

 private:
  [[nodiscard]] const FarsVehicle& ego() const { return crash_.vehicles[roles_.ego]; }
  [[nodiscard]] const FarsVehicle& other() const { return crash_.vehicles[*roles_.other]; }
  [[nodiscard]] const families::FamilyRange& range(std::string_view key) const {
    return family_.ranges.find(key)->second;
  }
  void set(std::string_view key, Span span, std::string source) {
    family_.ranges[std::string(key)] = {span.min, span.max, std::move(source)};
  }
  void set_share(std::string_view key, double share, std::string source) {
    set(key, {share, share}, std::move(source));
  }
  void refuse(std::string why) {
    problem_ = problem_ ? problem_ : Error{Error::Code::out_of_range, std::move(why)};
  }

  void narrow_ego();
  void narrow_road();
  void narrow_roadside();
  void narrow_lanes(int lanes, const std::string& source);
  void narrow_other();
  void narrow_lead();
  void narrow_crossing();
  void narrow_turn();
  void narrow_person();
  void narrow_head_on();
  void set_other_speed(SpeedRole role);

  const FarsCrash& crash_;
  const Roles& roles_;
  const FarsCodes& codes_;
  families::Family family_;
  std::optional<Error> problem_;
};

void Making::narrow_ego() {
  const auto speed = recorded_speed(ego(), SpeedRole::straight, codes_, "ego's");
  if (!speed) {
    return;
  }
  if (speed->middle() < slowest_ego) {
    refuse(fmt::format("the ego went {:.1f} m/s, less than {} m/s", speed->middle(), slowest_ego));
    return;
  }
  if (speed->middle() > fastest_ego) {
    refuse(fmt::format("the ego went {:.1f} m/s, more than {} m/s", speed->middle(), fastest_ego));
    return;
  }
  set("ego_speed_mps",
      {std::max(slowest_ego, speed->span.min), std::min(fastest_ego, speed->span.max)},
      speed->source);
}

void Making::narrow_lanes(int lanes, const std::string& source) {
  const int way = ego().trafficway.value_or(0);
  const bool both_ways = way == 1 || way == 5;
  if (lanes == 1 || (both_ways && lanes == 2)) {
    set_share("left_lane_share", both_ways && lanes == 2 ? 1.0 : 0.0, source);
    set_share("oncoming_share", both_ways && lanes == 2 ? 1.0 : 0.0, source);
    set_share("right_lane_share", 0.0, source);
  } else if (both_ways) {
    const std::string which = source + "; which of its lanes is not recorded";
    set_share("left_lane_share", 1.0, which);
    set_share("oncoming_share", 0.5, which);
    set_share("right_lane_share", 0.5, which);
  } else {
    const std::string which = source + "; which of its lanes is not recorded";
    set_share("left_lane_share", 0.5, which);
    set_share("oncoming_share", 0.0, which);
    set_share("right_lane_share", 0.75, which);
  }
}

/// Who comes from beside the road comes through what stands there.
void Making::narrow_roadside() {
  const bool vehicle = roles_.kind == FamilyKind::crossing || roles_.kind == FamilyKind::turning;
  const bool person = roles_.kind == FamilyKind::pedestrian || roles_.kind == FamilyKind::cyclist;
  const std::string source = std::string(by_crash_prefix) + "somebody comes from beside the road";
  if (vehicle || person) {
    set_share("barrier_share", 0.0, source);
  }
  if (vehicle) {
    set_share("trees_share", 0.0, source);
  }
}

void Making::narrow_road() {
  if (const auto grip = codes_.grip(ego().surface)) {
    set("grip", *grip,
        fmt::format("{}VSURCOND {}; friction by data/crash_records", recorded_prefix,
                    codes_.meaning("VSURCOND", ego().surface)));
  }
  set("lane_width_m", {3.05, 3.66},
      "assumption: AASHTO, A Policy on Geometric Design of Highways and Streets: lanes of 10 to 12 "
      "ft, as remembered");
  if (ego().lanes && ego().trafficway) {
    narrow_lanes(*ego().lanes,
                 fmt::format("{}{} lanes (VNUM_LAN), {} (VTRAFWAY)", recorded_prefix, *ego().lanes,
                             codes_.meaning("VTRAFWAY", ego().trafficway)));
  }
  const bool fast = ego().speed_limit && *ego().speed_limit >= 45;
  if (fast && family_.ranges.contains("parked_share")) {
    set_share("parked_share", 0.0,
              "assumption: nobody parks beside a road with a limit of 45 mph or more (VSPD_LIM)");
  }
  narrow_roadside();
  // What the kind itself needs stands, whatever the lanes.
  if (roles_.kind == FamilyKind::head_on ||
      (roles_.kind == FamilyKind::turning && roles_.from_left.value_or(false))) {
    const std::string source = std::string(by_crash_prefix) + "it comes from there";
    set_share("left_lane_share", 1.0, source);
    set_share("oncoming_share", 1.0, source);
  }
}

void Making::narrow_other() {
  const auto kind = codes_.kind_of_body(other().body);
  const std::string source =
      fmt::format("{}the other is a {} (BODY_TYP {})", recorded_prefix,
                  codes_.meaning("BODY_TYP", other().body), other().body.value_or(0));
  set_share("van_share", kind == ActorKind::van ? 1.0 : 0.0, source);
  set_share("truck_share", kind == ActorKind::truck ? 1.0 : 0.0, source);
  set_share("motorcycle_share", kind == ActorKind::motorcycle ? 1.0 : 0.0, source);
  if (roles_.from_left && family_.ranges.contains("from_left_share")) {
    set_share("from_left_share", *roles_.from_left ? 1.0 : 0.0,
              fmt::format("{}ACC_TYPE {}: from the {}", recorded_prefix,
                          ego().crash_type.value_or(0), *roles_.from_left ? "left" : "right"));
  }
}

void Making::set_other_speed(SpeedRole role) {
  constexpr int least = 3;         // [mph]: who stood did not come into the lane
  constexpr double slowest = 1.0;  // [m/s]
  FarsVehicle vehicle = other();
  std::string doubt;
  if (vehicle.travel_speed && *vehicle.travel_speed < least) {
    doubt = fmt::format(" (TRAV_SP {} mph is not believed)", *vehicle.travel_speed);
    vehicle.travel_speed = std::nullopt;
  }
  if (const auto speed = recorded_speed(vehicle, role, codes_, "other's")) {
    set("other_speed_mps",
        {std::clamp(speed->span.min, slowest, fastest_other),
         std::clamp(speed->span.max, slowest, fastest_other)},
        speed->source + doubt);
  }
}

void Making::narrow_lead() {
  if (roles_.kind == FamilyKind::lead_brakes) {
    return;  // as fast as the ego, then hard: what is known of it is known of the ego
  }
  const Code& type = ego().crash_type;
  if (type == 20) {
    set("lead_mps", {0.0, 0.0}, fmt::format("{}ACC_TYPE 20: it stood", recorded_prefix));
    return;
  }
  const auto speed = recorded_speed(other(), SpeedRole::slower, codes_, "other's");
  if (!speed) {
    return;
  }
  families::FamilyRange& ego_speed = family_.ranges.find("ego_speed_mps")->second;
  const double most = ego_speed.max - least_closing;
  if (speed->recorded && speed->span.min > most) {
    refuse(fmt::format("the one ahead went {:.1f} m/s, the ego not faster", speed->middle()));
    return;
  }
  const double least = std::min(most, speed->middle()) + least_closing;
  if (speed->recorded && !ego().travel_speed && least > ego_speed.min) {
    ego_speed.min = least;
    ego_speed.source += "; faster than the one ahead";
  }
  set("lead_mps", {std::min(speed->span.min, most), std::min(speed->span.max, most)},
      fmt::format("{}; slower than the ego by {} m/s at least, by the crash", speed->source,
                  least_closing));
}

void Making::narrow_crossing() {
  set_other_speed(SpeedRole::crossing);
  const families::FamilyRange& speed = range("other_speed_mps");
  const double pace = 0.5 * (speed.min + speed.max);
  const double ego_pace = 0.5 * (range("ego_speed_mps").min + range("ego_speed_mps").max);
  const double length =
      families::Stage::length_of(codes_.kind_of_body(other().body).value_or(ActorKind::car));
  const world::Footprint& body = scenario::standard_ego;
  if (roles_.struck == collision::Face::front) {
    const double half = 0.4 * length / pace;
    set("late_s", {-half, half},
        fmt::format("{}ACC_TYPE {}: the ego strikes its side, at speeds in the middle of their "
                    "ranges",
                    by_crash_prefix, ego().crash_type.value_or(0)));
  } else {
    // Its front meets our side when a share of our length has gone by.
    const double until_side = 0.5 * (length + body.width) / pace;
    set("late_s",
        {until_side + 0.1 * body.length / ego_pace, until_side + 0.9 * body.length / ego_pace},
        fmt::format("{}ACC_TYPE {}: it strikes the ego's side, at speeds in the middle of their "
                    "ranges",
                    by_crash_prefix, ego().crash_type.value_or(0)));
  }
}

void Making::narrow_turn() {
  struct Way {
    int type;
    double from_deg;
    double turn_deg;
    const char* words;
  };
  constexpr std::array<Way, 4> ways{{{69, 180.0, 90.0, "comes towards us and turns left"},
                                     {77, -90.0, 90.0, "comes from the left and turns left"},
                                     {79, 90.0, -90.0, "comes from the right and turns right"},
                                     {83, 90.0, 90.0, "comes from the right and turns left"}}};
  constexpr double spread = 10.0;  // [deg]: assumption
  for (const Way& way : ways) {
    if (ego().crash_type == way.type) {
      const std::string source =
          fmt::format("{}ACC_TYPE {}: {}", recorded_prefix, way.type, way.words);
      set("from_deg", {way.from_deg, way.from_deg}, source);
      // Who turns into a lane ends along it.
      const double play = way.from_deg == 180.0 ? spread : 0.0;
      set("turn_deg", {way.turn_deg - play, way.turn_deg + play}, source);
    }
  }
  // A turn is driven with at most 4 m/s^2 aside (assumption), so on 6 to 12 m at 4.9 to 6.9 m/s.
  constexpr double fastest = 6.0;       // [m/s]
  constexpr double least_radius = 9.0;  // [m] for that
  if (other().travel_speed.value_or(0) > 0) {
    const auto speed = recorded_speed(other(), SpeedRole::crossing, codes_, "other's");
    const bool is_of_turn = speed->span.max <= fastest;
    set("other_speed_mps",
        {std::clamp(speed->span.min, 2.0, fastest - 1.0),
         std::clamp(speed->span.max, 3.0, fastest)},
        is_of_turn
            ? speed->source
            : speed->source + "; in the turn not above 6 m/s (4 m/s^2 on 9 m), an assumption");
  }
  set("radius_m", {least_radius, 12.0},
      "assumption: from a tight turn at a junction to a wide one");
}

void Making::narrow_head_on() {
  set_other_speed(SpeedRole::oncoming);
  const bool sideswipe = ego().crash_type == 65;
  set("drift_to_m", sideswipe ? Span{0.9, 1.6} : Span{-0.6, 1.2},
      fmt::format("{}ACC_TYPE {}: {}", by_crash_prefix, ego().crash_type.value_or(0),
                  sideswipe ? "sides touch" : "fronts meet"));
  set("done_before_s", {-0.3, 1.2},
      std::string(by_crash_prefix) + "it is in the ego's lane when both meet");
}

void Making::narrow_person() {
  const FarsPerson& person = crash_.persons[*roles_.person];
  if (roles_.kind == FamilyKind::cyclist) {
    constexpr double slow = 8.0;  // [m/s]: hardly faster than a bicycle
    const families::FamilyRange& speed = range("ego_speed_mps");
    if (0.5 * (speed.min + speed.max) < slow) {
      set_share("along_share", 0.0,
                std::string(by_crash_prefix) + "so slow an ego strikes nobody who rides along");
    }
    return;
  }
  if (person.age && *person.age >= 65) {
    set("walk_mps", {0.8, 1.4},
        fmt::format("{}AGE {}; walking speed by the MUTCD, 3.0 to 3.5 ft/s for older people, as "
                    "remembered, and faster",
                    recorded_prefix, *person.age));
  }
  for (const char* key : {"chance_stop", "chance_run"}) {
    set_share(key, 0.0, std::string(by_crash_prefix) + "walked on");
  }
  const auto walkers = std::count_if(crash_.persons.begin(), crash_.persons.end(),
                                     [](const FarsPerson& one) { return one.type == 5; });
  set_share("second_share", walkers > 1 ? 1.0 : 0.0,
            fmt::format("{}{} on foot (PER_TYP)", recorded_prefix, walkers));
}

Result<families::Family> Making::made() {
  narrow_ego();
  narrow_road();
  if (roles_.other) {
    narrow_other();
  }
  switch (roles_.kind) {
    case FamilyKind::slower_lead:
    case FamilyKind::lead_brakes:
      narrow_lead();
      break;
    case FamilyKind::sideswipe:
      set_other_speed(SpeedRole::changing_lane);
      break;
    case FamilyKind::head_on:
      narrow_head_on();
      break;
    case FamilyKind::crossing:
      narrow_crossing();
      break;
    case FamilyKind::turning:
      narrow_turn();
      break;
    default:
      narrow_person();
      break;
  }
  if (problem_) {
    return *problem_;
  }
  family_.name = record_name(crash_.id);
  family_.title =
      fmt::format("{}: {} {}, case {}", codes_.meaning("ACC_TYPE", ego().crash_type),
                  codes_.meaning("STATE", crash_.id.state()), crash_.id.year, crash_.id.number);
  family_.why = "A fatal crash that was recorded, played with a car that can avoid it.";
  return family_;
}

}  // namespace

Result<BaseFamilies> load_base_families(const std::filesystem::path& folder) {
  BaseFamilies base;
  for (const FamilyKind kind : {FamilyKind::slower_lead, FamilyKind::lead_brakes,
                                FamilyKind::sideswipe, FamilyKind::head_on, FamilyKind::crossing,
                                FamilyKind::turning, FamilyKind::pedestrian, FamilyKind::cyclist}) {
    auto family = families::load_family(folder, name(kind));
    if (!family.has_value()) {
      return family.error();
    }
    base.emplace(kind, std::move(family).value());
  }
  return base;
}

std::string record_name(const CrashId& id) {
  return fmt::format("fars_{}_{}", id.year, id.number);
}

Result<families::Family> family_of(const FarsCrash& crash, const Roles& roles,
                                   const FarsCodes& codes, const BaseFamilies& base) {
  return Making(crash, roles, codes, base.at(roles.kind)).made();
}

}  // namespace saca::crash_records
