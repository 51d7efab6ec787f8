#include "apps/saca/options.h"
#include "saca/lab/curricula/bank_place.h"
#include "saca/lab/curricula/curriculum_json.h"
#include "saca/lab/curricula/curriculum_text.h"
#include "saca/lab/curricula/learning_curves.h"
#include "saca/lab/curricula/lessons.h"
#include "saca/lab/long_work/interrupt.h"
#include "saca/lab/long_work/output_file.h"

namespace saca::app {
namespace {

using curricula::LearnRequest;

struct LearnOptions {
  LearnRequest learn{.from = {.count = 200}};
  std::string svg;  ///< empty: none
  bool as_json = false;
};

ExitCode learn(const LearnOptions& options) {
  LearnRequest request = options.learn;
  if (request.folder.empty()) {
    request.folder = usual_folder(request);
  }
  const fs::path journal = curricula::journal_place(request);
  need_distinct({{"--svg", options.svg}},
                {{"--memory", request.from.thinking.memory}, {"the journal", journal}});
  need_writable({journal, options.svg});
  need(long_work::make_folder_of(journal));
  need(curricula::why_in_the_way(request.from.thinking.memory, request.folder));
  long_work::watch_for_interrupt();
  curricula::Lessons lessons = need(curricula::open_lessons(here(), request));
  const auto all = need_whole(curricula::taught(here(), lessons, request));
  const std::string suite = suite_of(request);
  nlohmann::json figures = with_meta(curricula::json_of(all, suite), command_text(request));
  figures["meta.memory"] = lessons.digest.start;
  if (const auto model = lessons.thinking->model_text()) {
    figures["meta.model"] = *model;
  }
  if (!options.svg.empty()) {
    write(options.svg, report::chart_svg(curricula::learning_curves(all, suite)));
  }
  tell(options.as_json, figures,
       fmt::format("{}\nbanks: {}/seed-*/\n", curricula::text_of(all), request.folder));
  return figures["learn." + suite + ".faults"].get<int>() > 0 ? some_failed : success;
}

}  // namespace

void add_learn(CLI::App& line) {
  const auto [command, options] = add_command<LearnOptions>(
      line, "learn",
      "Goes through encounters one after the other and remembers them; beside it the same that "
      "remembers nothing, and one that is lied to",
      learn);
  LearnRequest& request = options.learn;
  suites::SuiteRequest& from = request.from;
  add_encounter_options(command, from);
  command.get_option("--count")->description("How many encounters of each seed");
  add_thinking_options(command, from.thinking.memory, from.thinking.model);
  CLI::Option* const memory = command.get_option("--memory");
  memory->description(
      "The bank that all begin with, which stays as it is (default: the shipped cases)");
  command.add_flag("--empty-memory", request.empty_memory, "All begin with no case")
      ->excludes(memory);
  add(command, "--seeds", request.seeds, "How many such ways, each with encounters of its own",
      CLI::Range(1, 100));
  add(command, "--lies", request.lies,
      "Share of what one memory is told that is the opposite of the truth", within(0.0, 1.0));
  command.add_flag("--no-twins", from.no_twins,
                   "Without those without risk, which half of the encounters else are");
  add(command, "-o,--output", request.folder,
      "The folder for banks and journal (default: runs/learn-...)");
  add(command, "--svg", options.svg, "Draw how regret and memory change");
  add_threads(command, from.threads);
  add_json(command, options.as_json);
}

}  // namespace saca::app
