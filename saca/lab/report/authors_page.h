#pragma once

#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/lab/report/value_map.h"
#include "saca/lab/report/value_png.h"
#include "saca/lab/verification/authors_comparison.h"
#include "saca/lab/verification/authors_network.h"
#include "saca/thinking/danger/value_table.h"

namespace saca::report {

/// Where a pair of maps is taken.
struct AuthorsView {
  double course = 0.0;  ///< [rad]
  double speed = 0.0;   ///< [m/s]
};

/// The network's values over a plane, as `value_map` has a table's.
/// @param size  columns and rows, two of each at least
/// @return      `inside` is `in_authors_range`
[[nodiscard]] ValueMap authors_map(const verification::AuthorsNetwork& network, const MapRange& x,
                                   const MapRange& y, const RasterSize& size,
                                   const AuthorsView& view);

/// One page: a solved value and the published network side by side, and how they agree.
struct AuthorsPage {
  std::string case_name, network_name;
  std::vector<Vec2> outline;  ///< of the obstacle [m]; empty: none
  std::vector<AuthorsView> views;
};

/// @param value  as it was compared
/// @return  HTML that needs no other file; an error when there is no memory for a picture
[[nodiscard]] Result<std::string> authors_page(const AuthorsPage& page,
                                               const danger::ValueAt& value,
                                               const verification::AuthorsNetwork& network,
                                               const verification::AuthorsComparison& comparison);

/// The maps alone, a pair in each row, as bytes of a PNG file.
/// @return  likewise
[[nodiscard]] Result<std::string> authors_png(const AuthorsPage& page, const danger::ValueAt& value,
                                              const verification::AuthorsNetwork& network);

}  // namespace saca::report
