#include <filesystem>
#include <memory>
#include <string>

#include "apps/saca/commands.h"
#include "apps/saca/places.h"
#include "apps/saca/printing.h"
#include "saca/base/core/file.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/lab/report/record_page.h"

namespace saca::app {
namespace {

struct ReportOptions {
  std::string record;
  std::string output;
};

int render(const ReportOptions& options) {
  const auto text = read_file(options.record, many_bytes);
  if (!text.has_value()) {
    return refused(text.error());
  }
  const auto page = report::html_report(text.value());
  if (!page.has_value()) {
    return refused({page.error().code, options.record + ": " + page.error().message});
  }
  const std::filesystem::path file =
      options.output.empty() ? std::filesystem::path(options.record).replace_filename("report.html")
                             : std::filesystem::path(options.output);
  if (const auto problem = long_work::write_output(file, page.value())) {
    return refused(*problem);
  }
  app::print("Report: {}\n", std::filesystem::absolute(file).string());
  return success;
}

}  // namespace

void add_report(CLI::App& line, int& exit_code) {
  CLI::App* const command =
      line.add_subcommand("report", "Make the page of a run again from its record");
  const auto options = std::make_shared<ReportOptions>();
  command->add_option("record", options->record, "A record.json that `saca run` left")->required();
  command->add_option("-o,--output", options->output,
                      "Where the page goes (default: report.html beside the record)");
  command->callback([options, &exit_code] { exit_code = render(*options); });
}

}  // namespace saca::app
