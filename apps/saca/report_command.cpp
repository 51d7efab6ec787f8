#include "apps/saca/options.h"
#include "saca/base/core/file.h"
#include "saca/lab/report/record_page.h"

namespace saca::app {
namespace {

struct ReportOptions {
  std::string record;
  std::string output;
};

void render(const ReportOptions& options) {
  const std::string text = need(read_file(options.record, many_bytes));
  const auto page = report::html_report(text);
  if (!page.has_value()) {
    refuse({page.error().code, options.record + ": " + page.error().message});
  }
  const fs::path file = options.output.empty()
                            ? fs::path(options.record).replace_filename("report.html")
                            : fs::path(options.output);
  write(file, page.value());
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
