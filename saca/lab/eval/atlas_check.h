#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saca/base/core/proportion.h"
#include "saca/lab/eval/decision_point.h"
#include "saca/lab/families/family.h"
#include "saca/onboard/atlas/atlas.h"

namespace saca::eval {

/// One plan in one scene, as the atlas tells it and as full physics does.
struct AtlasRow {
  manoeuvre::Plan plan;
  bool refused = false;                      ///< by full physics
  std::optional<atlas::AtlasLimit> outside;  ///< of the atlas
  bool told_contact = false;
  bool true_contact = false;
  bool same_partner = false;    ///< where both have a contact: with the same body or edge
  bool same_face = false;       ///< likewise, of the ego
  double speed_off = 0.0;       ///< likewise, relative speed at it: told minus true [m/s]
  double time_off = 0.0;        ///< likewise [s]
  double told_clearance = 0.0;  ///< [m]
  double true_clearance = 0.0;  ///< [m]
  double probability = 0.0;     ///< of contact, as told
  double forecast_harm = 0.0;   ///< first contact only
  double true_harm = 0.0;       ///< of all contacts
  int later_contacts = 0;       ///< of full physics, after the first
  double told_chance = 0.0;     ///< of contact, when the grip is known to grip_sd_share only
  bool drawn_contact = false;   ///< with somebody, or an edge that stops, on grip drawn so
};

/// Standard deviation of the true grip over the believed one, where it is drawn (docs/formats.md,
/// the draws).
constexpr double grip_sd_share = 0.06;

/// What is held against physics: the eight policies, 3 and 4 to half of the speed, then braking
/// with each of manoeuvre::braking_strengths.
constexpr std::size_t num_checked = manoeuvre::num_policies + manoeuvre::braking_strengths.size();

/// All of these begun at a moment, the others on the tracks that they would take while the ego goes
/// on, known exactly; true grip is the believed one, but for drawn_contact.
/// @param seed  of the drawn grips
[[nodiscard]] std::array<AtlasRow, num_checked> atlas_rows(const DecisionPoint& point,
                                                           const atlas::Atlas& atlas,
                                                           const manoeuvre::Car& car,
                                                           const collision::HarmModel& harm,
                                                           std::uint64_t seed = 0);

/// The same at the trigger of sample `number` of a family; empty where it never triggers.
[[nodiscard]] std::vector<AtlasRow> atlas_rows(const families::Family& family, std::uint64_t seed,
                                               std::uint64_t number, const atlas::Atlas& atlas,
                                               const manoeuvre::Car& car,
                                               const collision::HarmModel& harm);

/// Plans whose told chance of contact lies between two bounds, and how many touch on drawn grip.
struct ChanceBin {
  double low = 0.0;   ///< [-]
  double high = 0.0;  ///< [-]; of the last bin included
  int plans = 0;
  double told = 0.0;   ///< mean
  Proportion touched;  ///< of them; without plans [0, 1]
};
constexpr std::array chance_bounds{0.0, 0.001, 0.2, 0.4, 0.6, 0.8, 0.999, 1.0};
using ChanceBins = std::array<ChanceBin, chance_bounds.size() - 1>;

/// Regret where no second contact follows on what the atlas chose, nor on the true best; the told
/// harm is then all there is.
struct LoneRegret {
  int scenes = 0;
  double mean = 0.0;             ///< in these scenes
  double share = 0.0;            ///< of the regret of all scenes together
  double harm_off_p95 = 0.0;     ///< size of told less true harm, where both have one contact
  double lasting_off_p95 = 0.0;  ///< likewise where more follow
};

/// How good the atlas is over many scenes.
struct AtlasFigures {
  int scenes = 0;
  int plans = 0;               ///< that full physics does not refuse
  Proportion covered;          ///< of these, within the atlas' bounds
  Proportion agreement;        ///< on contact
  Proportion partner;          ///< of contacts of both: the same body or edge
  Proportion face;             ///< likewise: the same face of the ego
  double speed_p50 = 0.0;      ///< size of speed_off where both meet the same [m/s]
  double speed_p95 = 0.0;      ///< likewise
  double speed_max = 0.0;      ///< likewise
  double clearance_p95 = 0.0;  ///< where neither has contact and both pass within 5 m [m]
  double regret_mean = 0.0;    ///< true harm of the atlas' choice above that of the true best
  double regret_p95 = 0.0;     ///< likewise
  Proportion same_choice;      ///< of scenes: regret below collision::harm_tie
  LoneRegret lone;
  ChanceBins chances;  ///< on drawn grip
};

/// @param rows  those of each scene, all or none
[[nodiscard]] AtlasFigures atlas_figures(std::span<const std::vector<AtlasRow>> rows);

}  // namespace saca::eval
