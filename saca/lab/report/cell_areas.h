#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace saca::report {

/// Where the names of a map's areas go. An area is a set of cells with one key that hang together
/// by their sides.
///
/// @param keys     row-major   (rows x columns)
/// @param columns  > 0, divides the number of keys
/// @return         one cell of each area, in the order in which reading meets the areas: where the
///                 area is widest, counted in steps along rows and columns, and of such cells the
///                 one nearest to the area's middle
[[nodiscard]] std::vector<std::size_t> area_centres(std::span<const int> keys, std::size_t columns);

}  // namespace saca::report
