#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "saca/lab/recordings/ngsim_csv.h"
#include "saca/lab/recordings/recorded_set.h"

namespace saca::recordings {

/// Where the lanes of a section run: the middle of what its vehicles drove.
///
/// Local_X of each lane, its median over bins of 10 m of Local_Y and then over five bins, taken
/// where a bin and its neighbours hold 30 rows or more.
class NgsimLanes {
 public:
  explicit NgsimLanes(const std::vector<NgsimRow>& rows);

  struct Lane {
    double right = 0.0;  ///< of the centre from the section's left edge [m]
    double slope = 0.0;  ///< d right / d along [-]
    /// Between the centres of the lanes beside it; 12 ft where there are none in usual distance.
    double width = 0.0;  ///< [m]
    bool left_lane = false;
    bool right_lane = false;
  };
  /// @return  nullopt where too few drove
  [[nodiscard]] std::optional<Lane> at(int lane, double along) const;
  /// The farthest that a vehicle was seen [m].
  [[nodiscard]] double end() const { return end_; }

 private:
  [[nodiscard]] std::optional<double> centre(int lane, double along) const;

  std::map<int, std::vector<double>> centres_;  ///< by lane, then bin; NaN: not known
  double end_ = 0.0;
};

/// The recordings of a table, each of its own group: vehicles are numbered anew in each.
///
/// W lies at the section's beginning, x along it and y to the left. The heading is the direction of
/// the way over the last second, once that is 1 m, and along the lane before. Tracks are split
/// where frames are missing or the size changes (numbers are given twice); a vehicle's second row
/// of one frame is counted and passed over. The curvature is not known. The gap is not known either
/// where nobody is ahead and the section ends within lead_reach.
///
/// @param name  of the recordings, before their time
[[nodiscard]] RecordedSet set_of_ngsim(const NgsimTable& table, const std::string& name);

}  // namespace saca::recordings
