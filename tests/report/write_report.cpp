// write_report <record.json> <report.html>: for the test of the page.
#include <cstdio>

#include "saca/core/file.h"
#include "saca/report/html_report.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: write_report <record.json> <report.html>\n", stderr);
    return 2;
  }
  const auto record = saca::read_file(argv[1]);
  if (!record.has_value()) {
    std::fprintf(stderr, "%s\n", record.error().message.c_str());
    return 1;
  }
  const auto page = saca::report::html_report(record.value());
  if (!page.has_value()) {
    std::fprintf(stderr, "%s: %s\n", argv[1], page.error().message.c_str());
    return 1;
  }
  if (const auto error = saca::write_file(argv[2], page.value())) {
    std::fprintf(stderr, "%s\n", error->message.c_str());
    return 1;
  }
  return 0;
}
