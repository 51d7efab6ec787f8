#include "saca/base/world/cue.h"

#include <gtest/gtest.h>

namespace saca::world {
namespace {

TEST(Cue, NamesAreReadBack) {
  for (std::size_t k = 0; k < num_cue_kinds; ++k) {
    const auto kind = static_cast<CueKind>(k);
    EXPECT_EQ(cue_kind_from(name(kind)), kind);
  }
  EXPECT_EQ(name(CueKind::bus_at_stop), "bus_at_stop");
  EXPECT_EQ(name(CueKind::wet_leaves), "wet_leaves");  // the last
  EXPECT_FALSE(cue_kind_from("bus"));
}

}  // namespace
}  // namespace saca::world
