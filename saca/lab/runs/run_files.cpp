#include "saca/lab/runs/run_files.h"

#include "saca/lab/encounter/trace.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/report/record_in_words.h"
#include "saca/lab/report/record_page.h"
#include "saca/runtime/tape_json.h"

namespace saca::runs {
namespace {

std::optional<Error> write_report(const std::filesystem::path& file, const std::string& record) {
  const auto page = report::html_report(record);
  return page.has_value() ? long_work::write_output(file, page.value()) : page.error();
}

std::optional<Error> write_trace(const std::filesystem::path& file, const PlayedRun& run) {
  return long_work::write_output(file, file.extension() == ".csv"
                                           ? encounter::trace_csv(run.setup, run.record)
                                           : encounter::trace_jsonl(run.setup, run.record));
}

std::optional<Error> write_tape(const std::filesystem::path& file, const PlayedRun& run) {
  runtime::TapeFile by_this_program = *run.record.tape;
  by_this_program.header.program = run.program;
  return long_work::write_output(file, runtime::tape_text(by_this_program));
}

}  // namespace

std::optional<Error> write_run(const RunFiles& files, const PlayedRun& run) {
  std::optional<Error> problem;
  if (!files.record.empty()) {
    problem = long_work::write_output(files.record, run.record_text);
  }
  if (!problem && !files.report.empty()) {
    problem = write_report(files.report, run.record_text);
  }
  if (!problem && !files.trace.empty()) {
    problem = write_trace(files.trace, run);
  }
  if (!problem && !files.tape.empty() && run.record.tape) {
    problem = write_tape(files.tape, run);
  }
  return problem;
}

std::vector<std::string> in_short(const std::string& record_text) {
  const auto told = report::explanation(record_text, "the record");
  return told.has_value() ? told.value().front().sentences : std::vector<std::string>();
}

}  // namespace saca::runs
