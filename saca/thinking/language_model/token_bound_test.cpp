#include "saca/thinking/language_model/token_bound.h"

#include <gtest/gtest.h>

#include <string>

namespace saca::language_model::token_bound_test {
namespace {

// Numbers of tokens by SmolLM2's own tokeniser, each with a line end before it.
TEST(TokenBound, IsCloseAboveTheTokeniser) {
  struct Known {
    const char* text;
    int tokens;
  };
  for (const Known& each : {
           Known{"ego: 14 m/s, sliding 0.6 m/s left, intersection, grip 0.90", 29},
           Known{"obstacle1: 4.2 m long, 1.8 m wide, 16 m ahead, 6.4 m left, risk 0.94", 39},
           Known{"motorcycle1: 16 m ahead, 6.4 m left, moving right at 7.5 m/s, not seen now, "
                 "lane change right 0.88, TTC 0.9 s, risk 0.94",
                 56},
           Known{"pedestrian1: 16 m behind, 6.4 m right, moving backwards at 7.5 m/s, brake "
                 "moving left 0.88, risk 0.94",
                 44},
           Known{"nobody else", 4},
           Known{"12 more of lower risk", 7},
           Known{"left edge 5.2 m, kerb; right edge 1.8 m, oncoming lane", 23},
           Known{"Least harm:", 5},
           Known{"More harm:", 4},
           Known{"0 AEB: clear by 0.6 m, contact 45 % likely, no harm", 22},
           Known{"4 ES-B-R: leaves the road at 8.0 m/s, harm 0.013", 27},
           Known{"no case is alike", 5},
           Known{"A case 65 % alike: carried out 0 AEB, harm 0.032; best in hindsight 3 ES-B-L, "
                 "no harm",
                 38},
       }) {
    const int bound = tokens_at_most("\n" + std::string(each.text));
    EXPECT_GE(bound, each.tokens) << each.text;
    EXPECT_LE(bound, each.tokens + each.tokens / 10 + 1) << each.text;
  }
  EXPECT_EQ(tokens_at_most(""), 0);
}

}  // namespace
}  // namespace saca::language_model::token_bound_test
