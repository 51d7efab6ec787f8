#include "saca/lab/report/intention_page.h"

#include <fmt/format.h>

#include <string_view>

#include "saca/lab/report/palette.h"
#include "saca/lab/report/svg.h"

namespace saca::report {
namespace {

constexpr std::string_view page_style = R"(
:root { color-scheme: light; }
body { margin: 1.5rem auto; max-width: 1560px; padding: 0 1rem; background: #fff; color: #17202a;
  font: 15px/1.45 system-ui, "Liberation Sans", sans-serif; }
p { max-width: 90ch; margin: .4rem 0; }
.legend { position: sticky; top: 0; background: #fff; padding: .3rem 0; border-bottom: 1px solid #d3dae1; }
.samples { display: grid; grid-template-columns: repeat(auto-fill, minmax(490px, 1fr)); gap: 1rem; }
figure { margin: 0; border: 1px solid #d3dae1; border-radius: 4px; padding: .3rem; }
)";

}  // namespace

std::string intention_page(const IntentionPage& page) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
      "<style>{1}{2}</style></head>\n<body>\n<h1>{0}</h1>\n",
      escaped(page.title), page_style, svg_style);
  for (const std::string& line : page.lines) {
    html += fmt::format("<p>{}</p>\n", escaped(line));
  }
  html +=
      "<div class=\"legend\">" +
      svg_in_page(intention_legend_size, "What the colours mean", intention_legend({0.0, 0.0})) +
      "</div>\n<div class=\"samples\">\n";
  for (const IntentionSample& sample : page.samples) {
    html +=
        "<figure>" +
        svg_in_page(intention_sample_size(sample), sample.title, intention_sample_part(sample)) +
        "</figure>\n";
  }
  return html + "</div>\n</body></html>\n";
}

}  // namespace saca::report
