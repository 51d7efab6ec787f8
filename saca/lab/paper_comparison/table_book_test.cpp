#include "saca/lab/paper_comparison/table_book.h"

#include <gmock/gmock.h>

#include "saca/lab/paper_comparison/rows_for_test.h"

namespace saca::paper_comparison::table_book_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

TEST(TableBook, HoldsTablesAndHowTheyWereMade) {
  TableBook book = empty_book({.count = 12, .only = {"3"}}, "1.2.3");
  EXPECT_TRUE(book.figures.empty());
  add_table(book, some_figures(), {{"meta.model", "a model"}, {"meta.n", "12"}}, "");
  add_replies(book, {some_replies()});
  const nlohmann::json out = json_of(book);
  EXPECT_EQ(out["meta.command"], "saca tables --count 12 --seed 1 --table 3");
  EXPECT_EQ(out["meta.seed"], "1");
  EXPECT_EQ(out["meta.version"], "1.2.3");
  EXPECT_EQ(out["meta.model"], "a model");
  EXPECT_FALSE(out.contains("meta.n"));
  EXPECT_EQ(out["tables.3.saca.collision_loss.n"], 12);
  EXPECT_EQ(out["tables.4.3.model.asked"], 20);
  const report::SuitePage page = page_of(book);
  ASSERT_EQ(page.tables.size(), 2U);
  EXPECT_EQ(page.tables[1].heading, "Table IV: replies");
  EXPECT_THAT(page.footnotes, Contains("version: 1.2.3"));
  EXPECT_THAT(page.footnotes, Contains("model: a model"));
}

TEST(TableBook, TheTextEndsWithWhatWasPublished) {
  TableBook book = empty_book({}, "1.2.3");
  EXPECT_THAT(text_of(book), StartsWith("Published: arXiv 2504.00115; "));
  add_table(book, some_figures(), {},
            "1 of 12 encounters are left out; the first: encounter 3 aeb failed: it threw");
  const std::string text = text_of(book);
  EXPECT_THAT(text, StartsWith("Table III: one-way road\n"));
  EXPECT_THAT(text, HasSubstr("\n\nPublished: arXiv"));
  EXPECT_EQ(text.back(), '\n');
  EXPECT_THAT(text,
              HasSubstr("Table III: one-way road: 1 of 12 encounters are left out; the first: "
                        "encounter 3 aeb failed: it threw\n"));
  EXPECT_THAT(page_of(book).footnotes, Contains(HasSubstr("aeb failed")));
  EXPECT_THAT(json_of(book).at("meta.failures").get<std::string>(), HasSubstr("aeb failed"));
}

}  // namespace
}  // namespace saca::paper_comparison::table_book_test
