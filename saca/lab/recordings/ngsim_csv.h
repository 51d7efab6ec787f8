#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"

namespace saca::recordings {

// Trajectories of the Next Generation Simulation programme (NGSIM) as its CSV and text files hold
// them. Source of columns and units: Federal Highway Administration, Next Generation Simulation
// (NGSIM) Vehicle Trajectories and Supporting Data, doi:10.21949/1504477, its metadata.

/// Time between frames [s].
constexpr double ngsim_step = 0.1;

/// A vehicle in one frame, in SI units.
struct NgsimRow {
  std::int64_t vehicle = 0;
  std::int64_t frame = 0;
  double right = 0.0;          ///< of the front's centre from the section's left edge (Local_X) [m]
  double along = 0.0;          ///< of the front's centre from the section's beginning (Local_Y) [m]
  double length = 0.0;         ///< [m], > 0
  double width = 0.0;          ///< [m], > 0
  double speed = 0.0;          ///< [m/s], >= 0
  int vehicle_class = 0;       ///< 1 motorcycle, 2 car, 3 truck
  int lane = 0;                ///< 1 is the left-most; more than the through lanes: ramps
  std::int64_t preceding = 0;  ///< the vehicle ahead in the lane; 0: none in the section
  // Of the vehicle ahead, where the file tells it itself; NaN: look for its row.
  double lead_along = std::numeric_limits<double>::quiet_NaN();   ///< of its front [m]
  double lead_length = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  double lead_speed = std::numeric_limits<double>::quiet_NaN();   ///< [m/s]
};

/// Which recording a row belongs to: vehicles are numbered anew in each.
struct NgsimKey {
  std::string site;         ///< us101, i80; ngsim where the file does not tell
  std::int64_t minute = 0;  ///< of frame 0, since 1970, rounded; 0 where the file tells no time
  auto operator<=>(const NgsimKey&) const = default;
};

/// Rows of one or more files.
struct NgsimTable {
  std::map<NgsimKey, std::vector<NgsimRow>> recordings;
  std::map<std::string, std::size_t> skipped;  ///< how many rows, by reason
};

/// Reads a file line by line, in pieces of any size: the official one has 1.5 GB.
///
/// Known are comma-separated files with a line of names (feet, milliseconds; all sites in one), the
/// older ones of 18 columns without names, separated by spaces, and I-80's leader-follower pairs
/// (names, metres). Rows of arterials (Lankershim, Peachtree), whose lanes need a map, are counted
/// and passed over, and so is a last line without its end: it may be cut.
class NgsimReader {
 public:
  /// @param source  name for messages, usually the path
  /// @param table   rows are added to it; outlives the reader
  NgsimReader(std::string source, NgsimTable& table);

  /// @param bytes  the next piece; nothing happens after a problem
  void take(std::string_view bytes);
  /// After the last piece.
  /// @return  what was wrong first, Error::Code::malformed or out_of_range, naming source, line,
  ///          column, wanted and got: unknown or missing names, rows of another length, what is no
  ///          number or out of bounds, no row at all
  [[nodiscard]] std::optional<Error> finish();

 private:
  void take_line(std::string_view line, bool cut_off);
  void take_names(std::string_view line);
  void take_row(const std::vector<std::string_view>& fields);
  void fail(const std::string& message, Error::Code code = Error::Code::malformed);
  [[nodiscard]] double number(const std::vector<std::string_view>& fields, std::size_t column,
                              double least, double most);
  [[nodiscard]] std::int64_t whole(const std::vector<std::string_view>& fields, std::size_t column,
                                   double least, double most);

  std::string source_;
  NgsimTable& table_;
  std::string rest_;  ///< of the last piece: a line that goes on
  std::size_t line_ = 0;
  std::size_t num_rows_ = 0;
  char mark_ = '\0';                  ///< between columns; '\0': the first line is to come
  std::vector<std::string> names_;    ///< of the columns, in the file's order
  std::vector<std::size_t> columns_;  ///< where the wanted ones stand
  bool pairs_ = false;                ///< leaders and followers, metres
  std::optional<Error> problem_;
};

}  // namespace saca::recordings
