#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/onboard/atlas/atlas.h"
#include "saca/onboard/manoeuvre/car.h"

namespace saca::prepare {

/// Drives some points of the grid, of these numbers in the order of `Atlas`: each with the grip
/// that is believed, and with less and with more. This is the place where the atlas asks the
/// physics: the batch. A node does not depend on the others.
[[nodiscard]] std::vector<atlas::AtlasNode> atlas_nodes(const manoeuvre::Car& car,
                                                        const atlas::AtlasGrid& grid,
                                                        std::span<const std::size_t> numbers);

/// How a build goes on: nodes done, and of these those that the journal knew.
struct AtlasProgress {
  std::size_t done = 0;
  std::size_t remembered = 0;
};

using AtlasNodes = std::shared_ptr<const std::vector<atlas::AtlasNode>>;

/// Drives all of a grid.
///
/// @param threads  >= 1; they do not change the result
/// @param journal  what is done is kept there, and a later call goes on with it; empty: nowhere
/// @param go_on    told of progress now and then, from any thread, one at a time; false stops
/// @return         nullptr: stopped; else what `Atlas` takes. Errors are the journal's.
[[nodiscard]] Result<AtlasNodes> build_atlas(
    const manoeuvre::Car& car, const atlas::AtlasGrid& grid, int threads,
    const std::filesystem::path& journal, const std::function<bool(const AtlasProgress&)>& go_on);

}  // namespace saca::prepare
