#include "saca/lab/cases/opened_examples.h"

#include <fmt/core.h>

#include <filesystem>
#include <utility>

#include "saca/lab/cases/case_build.h"
#include "saca/lab/cases/model_replies.h"
#include "saca/lab/installation/model_sources.h"
#include "saca/lab/model_access/open_model.h"
#include "saca/thinking/language_model/prompt.h"

namespace saca::cases {

using installation::Installation;

Result<OpenedExamples> open_examples(const Installation& here, const ExampleOptions& options) {
  auto file = read_cases(options.file);
  if (!file.has_value()) {
    return file.error();
  }
  auto planes = vehicle_study::open_planes(here, options.car);
  if (!planes.has_value()) {
    return planes.error();
  }
  auto source = open_examples(std::move(file).value(), options, tools_of(*planes.value()),
                              here.root / "scenarios");
  if (!source.has_value()) {
    return source.error();
  }
  return OpenedExamples{std::move(planes).value(), std::move(source).value()};
}

std::string command_text(const ExportRequest& request) {
  return fmt::format("cases export {} --format {} {}", request.examples.file, request.format,
                     example_text(request.examples));
}

Result<std::optional<ExportedSets>> export_sets(const Installation& here,
                                                const ExportRequest& request) {
  auto opened = open_examples(here, request.examples);
  if (!opened.has_value()) {
    return opened.error();
  }
  OpenedExamples all = std::move(opened).value();
  const std::filesystem::path folder = request.output;
  auto gathered =
      all_examples(all.source, {.journal = (folder / "journal").string(),
                                .title = fmt::format("saca {} cases export --car {} --seed {}",
                                                     installation::version_text(here),
                                                     request.examples.car, request.examples.seed),
                                .display = here.display,
                                .threads = request.threads,
                                .words = request.examples.seed});
  if (!gathered.has_value()) {
    return gathered.error();
  }
  if (!gathered.value()) {
    return std::optional<ExportedSets>();
  }
  auto [examples, problems] = *std::move(gathered).value();
  for (const std::string& problem : problems) {
    here.notice(problem);
  }
  SetTallies tallies = set_tallies(examples);
  if (auto problem =
          write_sets(folder, examples, set_format_from(request.format).value(),
                     language_model::system_part(all.planes->inputs.harm),
                     data_card(all.source, tallies, command_text(request), here.version))) {
    return *std::move(problem);
  }
  return std::optional(ExportedSets{std::move(all), std::move(tallies), std::move(problems)});
}

std::string command_text(const EvalRequest& request) {
  return fmt::format("cases eval {} --set {}{} --llm {} {}", request.examples.file, request.set,
                     request.count ? fmt::format(" --count {}", *request.count) : "",
                     request.model + (request.unconstrained ? " --unconstrained" : ""),
                     example_text(request.examples));
}

Result<std::optional<EvaluatedReplies>> evaluate_model(const Installation& here,
                                                       const EvalRequest& request) {
  auto opened = open_examples(here, request.examples);
  if (!opened.has_value()) {
    return opened.error();
  }
  auto [planes, source] = std::move(opened).value();
  const std::vector<std::string> records = records_of(source.cases);
  auto chosen = cases_by_lot(std::move(source.cases), example_set_from(request.set).value(),
                             request.count.value_or(0), request.examples.file);
  if (!chosen.has_value()) {
    return chosen.error();
  }
  source.cases = std::move(chosen).value();
  SteadyClock clock;
  const auto model = model_access::open_needed_model(
      installation::model_sources(here), request.model, runtime::Pace::lockstep, clock, "--llm");
  if (!model.has_value()) {
    return model.error();
  }
  auto gathered = model_replies(
      source, *model.value(), clock,
      {.journal = request.output + ".journal",
       .title = fmt::format("saca {} cases eval --set {} --car {} --seed {}{}",
                            installation::version_text(here), request.set, request.examples.car,
                            request.examples.seed, request.unconstrained ? " --unconstrained" : ""),
       .display = here.display,
       .words = request.examples.seed,
       .constrained = !request.unconstrained});
  if (!gathered.has_value()) {
    return gathered.error();
  }
  if (!gathered.value()) {
    return std::optional<EvaluatedReplies>();
  }
  auto [replies, problems] = *std::move(gathered).value();
  sort_as_in_file(replies, records);
  return std::optional(
      EvaluatedReplies{std::move(replies), std::move(problems), model.value()->description()});
}

}  // namespace saca::cases
