#include "adapter.h"

#include <ggml.h>
#include <gguf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <llama.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace saca::model_host::adapter_test {
namespace {

using testing::HasSubstr;

/// A matrix or, of one row, a vector.
struct Matrix {
  std::string name;
  std::int64_t rows;
  std::int64_t columns;
  std::vector<float> values;
};

class AdapterTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }

  /// Writes a GGUF file.
  std::string write(const std::string& name, const std::vector<Matrix>& matrices,
                    const std::function<void(gguf_context*)>& describe = {},
                    ggml_type type = GGML_TYPE_F32) const {
    ggml_context* tensors =
        ggml_init({.mem_size = 1U << 20U, .mem_buffer = nullptr, .no_alloc = false});
    gguf_context* file = gguf_init_empty();
    if (describe) {
      describe(file);
    }
    for (const Matrix& one : matrices) {
      const bool is_vector = one.rows == 1;
      ggml_tensor* tensor = is_vector ? ggml_new_tensor_1d(tensors, GGML_TYPE_F32, one.columns)
                                      : ggml_new_tensor_2d(tensors, type, one.columns, one.rows);
      ggml_set_name(tensor, one.name.c_str());
      if (tensor->type == GGML_TYPE_F32) {
        std::copy(one.values.begin(), one.values.end(), static_cast<float*>(tensor->data));
      } else if (ggml_get_type_traits(type)->to_float == nullptr) {
        std::memset(tensor->data, 0, ggml_nbytes(tensor));  // what it holds is not looked at
      } else {
        ggml_quantize_chunk(type, one.values.data(), tensor->data, 0, one.rows, one.columns,
                            nullptr);
      }
      gguf_add_tensor(file, tensor);
    }
    EXPECT_TRUE(gguf_write_to_file(file, path(name).c_str(), false));
    gguf_free(file);
    ggml_free(tensors);
    return path(name);
  }

  static void describe_adapter(gguf_context* file) {
    gguf_set_val_str(file, "general.type", "adapter");
    gguf_set_val_str(file, "adapter.type", "lora");
    gguf_set_val_f32(file, "adapter.lora.alpha", 4.0F);
    gguf_set_val_str(file, "saca.base.sha256", "abc");
  }

  /// What is wrong with an adapter for a base of one 2 x 3 matrix `w`.
  std::string problem_of(const std::vector<Matrix>& matrices,
                         const std::function<void(gguf_context*)>& describe = describe_adapter) {
    const std::string base = write("base.gguf", {{"w", 2, 3, {1, 2, 3, 4, 5, 6}}});
    const auto problem =
        merge_adapter(base, "abc", write("bad.gguf", matrices, describe), path("out.gguf"));
    EXPECT_FALSE(std::filesystem::exists(path("out.gguf")));
    return problem ? problem->message : "";
  }

  std::filesystem::path folder_;
};

std::vector<float> read(const std::string& path, const std::string& name) {
  ggml_context* tensors = nullptr;
  gguf_context* file = gguf_init_from_file(path.c_str(), {.no_alloc = false, .ctx = &tensors});
  const ggml_tensor* tensor = ggml_get_tensor(tensors, name.c_str());
  std::vector<float> values(static_cast<std::size_t>(ggml_nelements(tensor)));
  if (tensor->type == GGML_TYPE_F32) {
    const auto* begin = static_cast<const float*>(tensor->data);
    values.assign(begin, begin + values.size());
  } else {
    ggml_get_type_traits(tensor->type)
        ->to_float(tensor->data, values.data(), static_cast<std::int64_t>(values.size()));
  }
  gguf_free(file);
  ggml_free(tensors);
  return values;
}

// W + 4 / 2 B A with A = [1 0 2; 0 1 0] and B = [1 3; -1 0].
TEST_F(AdapterTest, AddsTheProductToItsMatrix) {
  const std::string base =
      write("base.gguf", {{"w", 2, 3, {1, 2, 3, 4, 5, 6}}, {"norm", 1, 3, {7, 8, 9}}},
            [](gguf_context* file) {
              gguf_set_val_str(file, "general.architecture", "llama");
              gguf_set_val_u32(file, "general.file_type", LLAMA_FTYPE_MOSTLY_Q4_1);
            });
  const std::string adapter = write(
      "adapter.gguf", {{"w.lora_a", 2, 3, {1, 0, 2, 0, 1, 0}}, {"w.lora_b", 2, 2, {1, 3, -1, 0}}},
      describe_adapter);
  const auto problem = merge_adapter(base, "abc", adapter, path("out.gguf"));
  ASSERT_FALSE(problem) << problem->message;
  EXPECT_THAT(read(path("out.gguf"), "w"), testing::ElementsAre(3, 8, 7, 2, 5, 2));
  EXPECT_THAT(read(path("out.gguf"), "norm"), testing::ElementsAre(7, 8, 9));
  gguf_context* file = gguf_init_from_file(path("out.gguf").c_str(), {true, nullptr});
  EXPECT_STREQ(gguf_get_val_str(file, gguf_find_key(file, "general.architecture")), "llama");
  EXPECT_EQ(gguf_get_val_u32(file, gguf_find_key(file, "general.file_type")),
            LLAMA_FTYPE_MOSTLY_F16);
  gguf_free(file);
}

TEST_F(AdapterTest, AQuantisedMatrixCountsAsWhatItStandsFor) {
  std::vector<float> values(64);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<float>(i % 32) * 0.25F;
  }
  const std::string base = write("base.gguf", {{"w", 2, 32, values}}, {}, GGML_TYPE_Q8_0);
  const std::string adapter =
      write("adapter.gguf",
            {{"w.lora_a", 2, 32, std::vector<float>(64, 0.5F)}, {"w.lora_b", 2, 2, {1, 0, 0, 0}}},
            describe_adapter);
  ASSERT_FALSE(merge_adapter(base, "abc", adapter, path("out.gguf")));
  const std::vector<float> merged = read(path("out.gguf"), "w");
  for (std::size_t i = 0; i < merged.size(); ++i) {
    EXPECT_NEAR(merged[i], values[i] + (i < 32 ? 1.0F : 0.0F), 0.04F) << i;
  }
}

TEST_F(AdapterTest, SaysWhatIsWrong) {
  const Matrix a{"w.lora_a", 2, 3, {1, 0, 2, 0, 1, 0}};
  const Matrix b{"w.lora_b", 2, 2, {1, 3, -1, 0}};
  EXPECT_EQ(problem_of({{"w.lora_a", 2, 2, {1, 0, 2, 0}}, b}),
            path("bad.gguf") +
                ": w: want r x n and m x r for an m x n matrix of the base, got 2 x 2 and 2 x 2 "
                "for 2 x 3");
  EXPECT_THAT(problem_of({a}), HasSubstr("got 2 x 3 and none for 2 x 3"));
  EXPECT_THAT(
      problem_of({{"v.lora_a", 2, 3, {1, 0, 2, 0, 1, 0}}, {"v.lora_b", 2, 2, {1, 3, -1, 0}}}),
      HasSubstr("v: want"));
  EXPECT_THAT(problem_of({a, b, {"w.norm", 2, 2, {1, 1, 1, 1}}}), HasSubstr("w.norm: want names"));
  EXPECT_THAT(problem_of({}), HasSubstr("want matrices, got none"));
  EXPECT_THAT(problem_of({a, b}, {}), HasSubstr("want an adapter (general.type"));
  EXPECT_THAT(problem_of({a, b},
                         [](gguf_context* file) {
                           describe_adapter(file);
                           gguf_set_val_str(file, "saca.base.sha256", "def");
                         }),
              HasSubstr("(sha256 abc), got one of `def`"));
}

TEST_F(AdapterTest, NumbersThatAreNoFloatsAreRefused) {
  const std::vector<Matrix> base{{"w", 2, 3, {1, 2, 3, 4, 5, 6}}};
  const std::vector<Matrix> pair{{"w.lora_a", 2, 3, {1, 0, 2, 0, 1, 0}},
                                 {"w.lora_b", 2, 2, {1, 3, -1, 0}}};
  for (const ggml_type type : {GGML_TYPE_I8, GGML_TYPE_I32, GGML_TYPE_F64}) {
    const auto problem =
        merge_adapter(write("base.gguf", base), "abc",
                      write("bad.gguf", pair, describe_adapter, type), path("out.gguf"));
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->code, Error::Code::malformed);
    EXPECT_EQ(problem->message, path("bad.gguf") +
                                    ": w.lora_a: want floating-point or quantised numbers, got " +
                                    ggml_type_name(type));
    EXPECT_FALSE(std::filesystem::exists(path("out.gguf")));
  }
  const auto of_base =
      merge_adapter(write("base.gguf", base, {}, GGML_TYPE_I8), "abc",
                    write("adapter.gguf", pair, describe_adapter), path("out.gguf"));
  ASSERT_TRUE(of_base);
  EXPECT_THAT(of_base->message, HasSubstr("w: want a matrix of floating-point or quantised numbers "
                                          "in the base, got i8"));
}

TEST_F(AdapterTest, FilesThatAreNoneAreNamed) {
  const std::string base = write("base.gguf", {{"w", 2, 3, {1, 2, 3, 4, 5, 6}}});
  std::ofstream(path("text.gguf")) << "no weights";
  EXPECT_THAT(merge_adapter(base, "abc", path("text.gguf"), path("out.gguf"))->message,
              HasSubstr(path("text.gguf") + ": want a GGUF file"));
  EXPECT_THAT(merge_adapter(path("none.gguf"), "abc", base, path("out.gguf"))->message,
              HasSubstr("none.gguf: want a GGUF file"));
  const std::string adapter = write(
      "adapter.gguf", {{"w.lora_a", 2, 3, {1, 0, 2, 0, 1, 0}}, {"w.lora_b", 2, 2, {1, 3, -1, 0}}},
      describe_adapter);
  EXPECT_EQ(merge_adapter(base, "abc", adapter, path("no/folder/out.gguf"))->code,
            Error::Code::unwritable);
}

}  // namespace
}  // namespace saca::model_host::adapter_test
