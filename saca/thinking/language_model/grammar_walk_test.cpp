#include "saca/thinking/language_model/grammar_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "saca/thinking/language_model/crowded_situation_for_test.h"
#include "saca/thinking/language_model/gbnf_for_test.h"
#include "saca/thinking/language_model/prompt.h"
#include "saca/thinking/language_model/reply_grammar.h"

namespace saca::language_model::grammar_walk_test {
namespace {

using Rest = GrammarWalk::Rest;

constexpr std::string_view small =
    "root ::= \"So \" (turn | \"brake\" (\" hard\")?) \".\\nGo\"\n"
    "turn ::= (\"left\" | \"leap\" | \"\") \" on\"\n";
constexpr std::array<std::string_view, 5> all_of_small{
    "So left on.\nGo", "So leap on.\nGo", "So  on.\nGo", "So brake.\nGo", "So brake hard.\nGo"};

/// Of the replies about a crowded scene.
std::string crowded_grammar(unsigned seed) {
  const preview::Situation situation = crowded_situation(seed);
  return reply_grammar(situation, scene_part(situation, std::nullopt, 0.0), std::nullopt);
}

/// By the texts themselves: what all of those that begin so go on with, and their next bytes.
struct Next {
  std::string forced;
  std::set<char> possible;
};
Next next_of(const std::string& begin) {
  std::vector<std::string> rests;
  for (const std::string_view text : all_of_small) {
    if (text.starts_with(begin)) {
      rests.emplace_back(text.substr(begin.size()));
    }
  }
  Next next;
  std::string common = rests.front();
  for (const std::string& rest : rests) {
    while (!rest.starts_with(common)) {
      common.pop_back();
    }
    if (!rest.empty()) {
      next.possible.insert(rest.front());
    }
  }
  next.forced = common;
  return next;
}

TEST(GrammarWalk, TellsWhatMustComeAndWhatMay) {
  for (const std::string_view text : all_of_small) {
    auto walk = GrammarWalk::make(small);
    ASSERT_TRUE(walk.has_value());
    for (std::size_t i = 0; i <= text.size(); ++i) {
      const Next next = next_of(std::string(text.substr(0, i)));
      const std::string possible = walk->possible();
      EXPECT_EQ(walk->forced(), next.forced) << "after " << text.substr(0, i);
      EXPECT_EQ(std::set<char>(possible.begin(), possible.end()), next.possible);
      EXPECT_EQ(possible.size(), next.possible.size()) << "each once";
      walk->take(text.substr(i, 1));
    }
  }
}

TEST(GrammarWalk, BehindWhatIsNotAllowedNothingMustCome) {
  auto walk = GrammarWalk::make(small);
  ASSERT_TRUE(walk.has_value());
  walk->take("So l");
  GrammarWalk other = *walk;
  other.take("x");
  EXPECT_EQ(other.forced(), "");
  EXPECT_EQ(other.possible(), "");
  EXPECT_EQ(walk->forced(), "e") << "a copy goes its own way";
}

// A text that may end need not go on, even where it can in one way only.
TEST(GrammarWalk, NothingMustComeWhereATextMayEnd) {
  auto walk = GrammarWalk::make("root ::= \"Go\" (\" on\")?\n");
  ASSERT_TRUE(walk.has_value());
  walk->take("Go");
  EXPECT_EQ(walk->forced(), "");
  EXPECT_EQ(walk->possible(), " ");
}

// What is begun is said to its end; what the reply comes to stays open.
TEST(GrammarWalk, ABriefTextLeavesOutWhatMayBeLeftOut) {
  auto walk = GrammarWalk::make(
      "root ::= \"1. \" (remark \"! 2. \" (conclusion | remark \"!\") | conclusion)\n"
      "remark ::= \"Near\" (\" by\")?\n"
      "conclusion ::= (\"So left\" | \"So right\") (\", mild\")? \".\"\n");
  ASSERT_TRUE(walk.has_value());
  EXPECT_EQ(walk->forced(), "1. ");
  EXPECT_EQ(walk->forced(Rest::brief), "1. So ");
  EXPECT_EQ(walk->longest_brief(), std::string_view("1. So right.").size());
  walk->take("1. ");
  EXPECT_EQ(walk->possible(), "NS");
  EXPECT_EQ(walk->possible(Rest::brief), "S");
  GrammarWalk begun = *walk;  // a statement is said to its end
  begun.take("Ne");
  EXPECT_EQ(begun.forced(), "ar");
  EXPECT_EQ(begun.forced(Rest::brief), "ar! 2. So ");
  EXPECT_EQ(begun.longest_brief(), std::string_view("ar! 2. So right.").size());
  begun.take("ar b");
  EXPECT_EQ(begun.forced(Rest::brief), "y! 2. So ");
  walk->take("So ");
  EXPECT_EQ(walk->possible(Rest::brief), "lr");
  walk->take("left");
  EXPECT_EQ(walk->forced(), "");
  EXPECT_EQ(walk->forced(Rest::brief), ".");
  walk->take(".");
  EXPECT_EQ(walk->forced(Rest::brief), "");
  EXPECT_EQ(walk->longest_brief(), 0U);
}

TEST(GrammarWalk, RefusesWhatItDoesNotKnow) {
  for (const char* grammar :
       {"", "root ::= [a-z]\n", "root ::= \"a\"*\n", "root ::= other\n", "root \"a\"\n",
        "root ::= \"a\n", "root ::= (\"a\"\n", "root ::= \"a\\x41\"\n", "root ::= \"a\" root\n",
        "other ::= \"a\"\n", "root ::= a?\na ::= \"a\"\n", "root ::= .\n"}) {
    EXPECT_FALSE(GrammarWalk::make(grammar).has_value()) << grammar;
  }
}

// Each alternative of a rule is built for each place where it is followed by something else.
TEST(GrammarWalk, RefusesWhatGrowsWithoutBounds) {
  std::string grammar = "root ::= a0 a0\n";
  for (int k = 0; k < 40; ++k) {
    grammar += "a" + std::to_string(k) + " ::= a" + std::to_string(k + 1) + " a" +
               std::to_string(k + 1) + "\n";
  }
  EXPECT_FALSE(GrammarWalk::make(grammar + "a40 ::= \"a\"\n").has_value());
}

// Texts drawn from the grammars of crowded scenes, by another reader of the notation: at each place
// they go on as they must, and as they may.
TEST(GrammarWalk, FollowsReplies) {
  std::size_t bytes = 0;
  std::size_t chosen = 0;  // where there is more than one way
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::string grammar = crowded_grammar(seed);
    const auto begin = GrammarWalk::make(grammar);
    ASSERT_TRUE(begin.has_value()) << grammar;
    EXPECT_EQ(begin->forced(), "Scenario Analysis\n1. ");
    const Gbnf reader(grammar);
    std::mt19937_64 random(seed);
    for (int k = 0; k < 10; ++k) {
      const std::string text = reader.drawn(random);
      GrammarWalk walk = *begin;
      for (std::size_t i = 0; i < text.size(); ++i) {
        const std::string forced = walk.forced();
        ASSERT_TRUE(std::string_view(text).substr(i).starts_with(forced)) << text.substr(0, i);
        ASSERT_NE(walk.possible().find(text[i]), std::string::npos) << text.substr(0, i);
        chosen += forced.empty() ? 1U : 0U;
        walk.take(std::string_view(text).substr(i, 1));
      }
      bytes += text.size();
      EXPECT_EQ(walk.possible(), "") << text;
    }
  }
  EXPECT_LT(chosen, bytes / 4) << "most of a reply leaves no choice";
}

// Wherever a reply is told to be brief, it says what it has begun, comes to its conclusion, and is
// a reply of the grammar.
TEST(GrammarWalk, EndsRepliesBriefly) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const std::string grammar = crowded_grammar(seed);
    const auto begin = GrammarWalk::make(grammar);
    ASSERT_TRUE(begin.has_value()) << grammar;
    const Gbnf reader(grammar);
    std::mt19937_64 random(seed);
    const std::string whole = reader.drawn(random);
    for (std::size_t i = 0; i <= whole.size(); ++i) {
      std::string text = whole.substr(0, i);
      GrammarWalk walk = *begin;
      walk.take(text);
      const std::size_t most = walk.longest_brief();
      for (std::string bytes = walk.possible(Rest::brief); !bytes.empty();
           bytes = walk.possible(Rest::brief)) {
        const std::string_view byte(&bytes[random() % bytes.size()], 1);
        walk.take(byte);
        text += byte;
      }
      EXPECT_TRUE(reader.accepts(text)) << text;
      EXPECT_LE(text.size() - i, most) << text;
      const std::string rest = text.substr(i);
      const auto statements = std::count(rest.begin(), rest.end(), '\n');
      EXPECT_LE(statements, 2) << "what was begun, and the conclusion: " << text;
    }
  }
}

}  // namespace
}  // namespace saca::language_model::grammar_walk_test
