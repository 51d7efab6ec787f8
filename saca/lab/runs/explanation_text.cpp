#include "saca/lab/runs/explanation_text.h"

#include <utility>

namespace saca::runs {

nlohmann::json explanation_json(const std::vector<report::Paragraph>& paragraphs) {
  nlohmann::json all = nlohmann::json::array();
  for (const report::Paragraph& paragraph : paragraphs) {
    all.push_back({{"about", paragraph.about}, {"sentences", paragraph.sentences}});
  }
  return {{"schema", "saca.explanation/1"}, {"paragraphs", std::move(all)}};
}

std::string explanation_text(const std::vector<report::Paragraph>& paragraphs) {
  std::string text;
  for (const report::Paragraph& paragraph : paragraphs) {
    text += paragraph.about + "\n";
    for (const std::string& sentence : paragraph.sentences) {
      text += "  " + sentence + "\n";
    }
  }
  return text;
}

}  // namespace saca::runs
