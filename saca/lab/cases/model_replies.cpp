#include "saca/lab/cases/model_replies.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

#include "saca/base/formats/json_lines.h"
#include "saca/lab/cases/case_stage.h"
#include "saca/lab/cases/drawn_examples.h"
#include "saca/lab/long_work/resumable_work.h"

namespace saca::cases {

namespace {

constexpr std::string_view replies_schema = "saca.example_replies/2";
// Of a case and its twin together: without haste, so that every reply comes to its end.
constexpr Clock::Time patience_with_model = std::chrono::seconds(180);

/// What was replied about one case and its twin.
using ReplyRow = long_work::ItemsRow<ExampleReply>;

/// @param failure  why the model cannot be asked any more, if that is so: the row is then worth
///                 nothing. That an answer is malformed is something that the model said
ReplyRow asked_about(DrawnExamples drawn, const ReplyWork& work,
                     language_model::LanguageModel& model, const Clock& clock,
                     std::optional<Error>& failure) {
  ReplyRow row{.items = {}, .problem = std::move(drawn.problem)};
  if (drawn.examples.empty()) {
    return row;
  }
  language_model::Question question;
  for (const DrawnExample& each : drawn.examples) {
    question.scenes.push_back(each.example.prompt);
    question.grammars.push_back(work.constrained ? each.grammar() : "");
  }
  const auto replies =
      model.ask(question.scenes, clock.now() + patience_with_model,
                [](const language_model::Progress&) {}, {.grammars = question.grammars});
  const std::string record = drawn.examples.front().example.record;
  const auto note = [&](const Error& problem) {
    row.problem = record + ": " + problem.message;
    if (problem.code != Error::Code::malformed) {
      failure = Error{problem.code, fmt::format("--llm: {} (in case {}; the same command goes on "
                                                "there)",
                                                problem.message, record)};
    }
  };
  if (!replies.has_value()) {
    note(replies.error());
    return row;
  }
  for (std::size_t i = 0; i < drawn.examples.size(); ++i) {
    const DrawnExample& each = drawn.examples[i];
    row.items.push_back(example_reply(each.example, replies.value()[i], each.situation));
    const auto grammar = [&](manoeuvre::PolicyId choice) {
      return work.constrained ? each.grammar(choice) : "";
    };
    if (const auto problem = try_again(row.items.back(), each.situation, model, clock, grammar)) {
      note(*problem);
    }
  }
  return row;
}

}  // namespace

Result<std::vector<CrashCase>> cases_by_lot(std::vector<CrashCase> cases, ExampleSet set,
                                            std::size_t most, const std::string& file) {
  std::erase_if(cases,
                [set](const CrashCase& one) { return set_of_record(one.record.name) != set; });
  if (cases.empty()) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want cases of the {} set, got none", file, name(set))};
  }
  const auto lot = [](const CrashCase& one) {
    return std::pair(number_of_record(one.record.name), one.record.name);
  };
  std::sort(cases.begin(), cases.end(),
            [&](const auto& a, const auto& b) { return lot(a) < lot(b); });
  if (most > 0 && cases.size() > most) {
    cases.resize(most);
  }
  return cases;
}

Result<std::optional<long_work::AllItems<ExampleReply>>> model_replies(
    const ExampleSource& source, language_model::LanguageModel& model, const Clock& clock,
    const ReplyWork& work) {
  std::optional<Error> failure;
  auto rows = long_work::rows_of<ReplyRow>(
      {.journal = work.journal,
       .title = fmt::format("{} ({:016x}) {}", work.title, source.digest, model.description()),
       .progress = "replies",
       .unit = "cases",
       .count = source.cases.size(),
       .display = work.display,
       .threads = 1,  // the model uses all cores
       .row =
           [&](std::size_t i) {
             return asked_about(drawn_examples(source.cases[i], source, work.words), work, model,
                                clock, failure);
           },
       .line_of = long_work::items_line<ExampleReply>,
       .row_from =
           [](const std::string& line) {
             return long_work::items_row<ExampleReply>(line, example_reply_from_json);
           },
       .spoilt_by_interrupt = true,  // it reaches the model's process, too
       .failure = [&failure] { return failure; }});
  if (!rows.has_value()) {
    return rows.error();
  }
  if (!rows.value()) {
    return std::optional<long_work::AllItems<ExampleReply>>();
  }
  return std::optional(long_work::all_items(*std::move(rows).value()));
}

std::vector<std::string> records_of(const std::vector<CrashCase>& cases) {
  std::vector<std::string> records;
  records.reserve(cases.size());
  std::transform(cases.begin(), cases.end(), std::back_inserter(records),
                 [](const CrashCase& one) { return one.record.name; });
  return records;
}

void sort_as_in_file(std::vector<ExampleReply>& replies, const std::vector<std::string>& records) {
  std::map<std::string, std::size_t> places;
  for (const std::string& record : records) {
    places.emplace(record, places.size());
  }
  std::stable_sort(replies.begin(), replies.end(),
                   [&](const ExampleReply& a, const ExampleReply& b) {
                     return places.at(a.example.record) < places.at(b.example.record);
                   });
}

std::string replies_text(const std::vector<ExampleReply>& replies) {
  std::string lines = formats::first_json_line(replies_schema, "replies", replies.size());
  for (const ExampleReply& one : replies) {
    lines += to_json(one).dump() + '\n';
  }
  return lines;
}

}  // namespace saca::cases
