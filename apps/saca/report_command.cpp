#include "apps/saca/options.h"
#include "saca/base/core/file.h"
#include "saca/lab/report/record_in_words.h"
#include "saca/lab/report/record_page.h"

namespace saca::app {
namespace {

struct ReportOptions {
  std::string record;
  std::string output;
};

void render(const ReportOptions& options) {
  const fs::path file = options.output.empty()
                            ? fs::path(options.record).replace_filename("report.html")
                            : fs::path(options.output);
  need_distinct({{"--output", file}}, {{"the record", options.record}});
  const std::string text = need(read_file(options.record, many_bytes));
  // What cannot be told of is no whole record.
  (void)need(report::explanation(text, options.record));
  write(file, need(report::html_report(text)));
  app::print("Report: {}\n", fs::absolute(file).string());
}

}  // namespace

void add_report(CLI::App& line) {
  const auto [command, options] = add_command<ReportOptions>(
      line, "report", "Make the page of a run again from its record", render);
  add_needed(command, "record", options.record, "A record.json that `saca run` left");
  add(command, "-o,--output", options.output,
      "Where the page goes (default: report.html beside the record)");
}

}  // namespace saca::app
