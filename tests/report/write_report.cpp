// write_report encounter|drive|value <record.json> <report.html>: for the tests of the pages.
#include <cstdio>
#include <string_view>

#include "saca/base/core/file.h"
#include "saca/lab/report/record_page.h"

int main(int argc, char** argv) {
  const std::string_view kind = argc == 4 ? argv[1] : "";
  if (kind != "encounter" && kind != "drive" && kind != "value") {
    std::fputs("usage: write_report encounter|drive|value <record.json> <report.html>\n", stderr);
    return 2;
  }
  const auto record = saca::read_file(argv[2]);
  if (!record.has_value()) {
    std::fprintf(stderr, "%s\n", record.error().message.c_str());
    return 1;
  }
  const auto page = kind == "drive"   ? saca::report::drive_report(record.value())
                    : kind == "value" ? saca::report::value_report(record.value())
                                      : saca::report::html_report(record.value());
  if (!page.has_value()) {
    std::fprintf(stderr, "%s: %s\n", argv[2], page.error().message.c_str());
    return 1;
  }
  if (const auto error = saca::write_file(argv[3], page.value())) {
    std::fprintf(stderr, "%s\n", error->message.c_str());
    return 1;
  }
  return 0;
}
