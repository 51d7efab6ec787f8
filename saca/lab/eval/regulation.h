#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/lab/eval/comparison.h"
#include "saca/lab/scenario/scenario.h"

namespace saca::eval {

// The tests that a regulation asks every car to pass, as a grid of encounters: files of
// data/protocols, schema saca.regulation/1 of docs/formats.md. All speeds are those before anybody
// brakes; the subject vehicle is the ego.

/// What a test is like.
enum class TestKind : std::uint8_t {
  stopped_lead,   ///< a car stands in the lane
  slower_lead,    ///< a car goes ahead at a lower, constant speed
  braking_lead,   ///< a car goes ahead at the ego's speed, and then brakes to rest
  crossing,       ///< somebody crosses the path perpendicularly
  standing,       ///< somebody stands in the path
  walking_along,  ///< somebody walks along the path, in the ego's direction
  steel_plate,    ///< a plate lies flat on the road: nobody is there
  pass_between,   ///< the path leads between two parked cars
  curve,          ///< in a left curve somebody stands behind its outer edge, straight ahead
};
/// As files have them.
constexpr std::array<std::string_view, 9> test_kind_names{
    "stopped_lead",  "slower_lead", "braking_lead", "crossing", "standing",
    "walking_along", "steel_plate", "pass_between", "curve"};
[[nodiscard]] std::string_view name(TestKind kind);

/// What must hold for a test to be passed.
enum class LimitKind : std::uint8_t {
  no_contact,       ///< nobody is touched while the ego moves
  impact_speed,     ///< who is touched is touched at no more than a speed
  deceleration,     ///< the ego decelerates by less than a limit
  no_intervention,  ///< the ego goes on as it did
};
/// As files have them.
constexpr std::array<std::string_view, 4> limit_kind_names{"no_contact", "impact_speed",
                                                           "deceleration", "no_intervention"};
[[nodiscard]] std::string_view name(LimitKind kind);

/// A test device.
struct TestTarget {
  std::string name;     ///< "car", "adult", "child" or "bicycle"
  double length = 0.0;  ///< along its heading [m]
  double width = 0.0;   ///< [m]
  double mass = 0.0;    ///< [kg]
  std::string source;
};

/// Two parked cars, one behind the other, that hide who crosses.
struct ParkedCars {
  double between = 0.0;  ///< from one to the other [m]
  double before_target =
      0.0;  ///< from the front of the farther one to who crosses, along the road [m]
  double beside_subject = 0.0;  ///< from the ego's side to theirs [m]
};

/// One test at several speeds.
struct RegulationRow {
  std::string name;
  std::string title;
  TestKind kind{};
  std::string paragraph;           ///< of the text
  std::vector<double> speeds;      ///< of the ego [m/s]
  double time_to_collision = 0.0;  ///< at the start [s]; of `braking_lead` there is none
  bool manual_braking = false;     ///< the text lets the driver brake too; nobody does here
  LimitKind limit{};
  std::vector<double> impact_speeds;  ///< of `impact_speed`: largest, one per speed [m/s]
  double peak_deceleration = 0.0;     ///< of `deceleration`: must stay below [m/s^2]
  double lead_speed = 0.0;            ///< of `slower_lead` [m/s]
  std::vector<double> headways;       ///< of `braking_lead` [m]
  std::vector<double> decelerations;  ///< of `braking_lead`: of the lead [m/s^2], > 0
  double following = 0.0;             ///< of `braking_lead`: before the lead brakes [s]
  TestTarget target;                  ///< who crosses, stands or walks
  bool from_right = true;             ///< of who crosses, stands or walks
  double target_speed = 0.0;          ///< [m/s]
  /// Share of the ego's width, from the side the target comes from, at which its middle meets the
  /// ego's front if nobody brakes [-].
  double overlap = 0.0;
  std::optional<double> start_offset;  ///< of who crosses, from the path [m]; nullopt: it crosses
                                       ///< at constant speed from the start on
  double speed_within = 0.0;           ///< way in which who starts there reaches its speed [m]
  std::optional<ParkedCars> parked;
  double gap = 0.0;           ///< of `pass_between`: between the parked cars' sides [m]
  double outer_radius = 0.0;  ///< of `curve`: of the road's outer edge [m]
};

/// Time that who crosses needs from its start to where it meets a car of some width [s].
/// @param row        with a start offset
/// @param ego_width  [m]
[[nodiscard]] double crossing_time(const RegulationRow& row, double ego_width);

/// On which tests are run.
struct TestSurface {
  std::string name;
  double grip = 0.9;  ///< friction coefficient [-]
  std::string source;
};

struct Regulation {
  std::string name;
  std::string title;
  std::string source;
  std::vector<TestSurface> surfaces;  ///< at least one
  std::size_t surface = 0;            ///< index of the one on which encounters are made
  double least_braking = 0.0;         ///< deceleration from which on the ego has braked [m/s^2]
  std::string least_braking_source;
  double free_width = 0.0;  ///< free of obstacles to either side of the path [m]
  double lane_width = 0.0;  ///< [m]
  TestTarget car;           ///< that goes ahead or is parked
  std::vector<RegulationRow> rows;
  std::vector<std::string> notes;  ///< what the grid leaves out or takes another way, in sentences
};

/// One test at one speed.
struct RegulationCell {
  std::size_t row = 0;                 ///< index into Regulation::rows
  double speed = 0.0;                  ///< of the ego [m/s]
  std::optional<double> headway;       ///< of `braking_lead` [m]
  std::optional<double> deceleration;  ///< of `braking_lead` [m/s^2]
  std::optional<double> impact_speed;  ///< largest that is allowed, where one is [m/s]
};

/// All cells, row by row.
[[nodiscard]] std::vector<RegulationCell> cells_of(const Regulation& regulation);

/// What a cell differs by from others of its row: "80 km/h", "50 km/h, 12 m, 0.3 g".
[[nodiscard]] std::string label_of(const RegulationCell& cell);

/// The encounter of a cell. Perception is exact, except that parked cars hide who is behind them.
/// @param ego  body of the car that is tested, about its centre of mass
[[nodiscard]] scenario::Scenario scenario_of(const Regulation& regulation,
                                             const RegulationCell& cell,
                                             const world::Footprint& ego);

/// What the text says of a run.
enum class TestVerdict : std::uint8_t {
  passed,
  contact,         ///< touches where nobody may be touched, or faster than is allowed
  no_braking,      ///< touches nobody, but by steering alone, where the text asks for braking
  false_reaction,  ///< decelerates or acts where the text asks for going on
  fault,           ///< the method failed
};
[[nodiscard]] std::string_view name(TestVerdict verdict);

struct CellResult {
  TestVerdict verdict = TestVerdict::passed;
  /// At which somebody was touched [m/s]: relative to cars ahead, as UN R152, 5.2.1.4, has it, of
  /// the ego for all others; 0: nobody was while the ego moved.
  double impact_speed = 0.0;
  double peak_deceleration = 0.0;  ///< of the ego [m/s^2]

  [[nodiscard]] bool passed() const { return verdict == TestVerdict::passed; }
};

/// Judges a run by the text's own rule.
/// @param run  of the cell's scenario
[[nodiscard]] CellResult judged(const Regulation& regulation, const RegulationCell& cell,
                                const MethodRun& run);

}  // namespace saca::eval
