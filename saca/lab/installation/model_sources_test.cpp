#include "saca/lab/installation/model_sources.h"

#include <gtest/gtest.h>

#include "saca/lab/installation/here_for_test.h"

namespace saca::installation::model_sources_test {
namespace {

TEST(ModelSources, AreTheProgramsOwnFilesAndItsKey) {
  const auto sources = model_sources(here_for_test());
  EXPECT_EQ(sources.host, "no_host");
  EXPECT_EQ(sources.key, "key");
  EXPECT_TRUE(std::filesystem::exists(sources.harm));
  EXPECT_TRUE(std::filesystem::exists(sources.temperatures));
}

}  // namespace
}  // namespace saca::installation::model_sources_test
