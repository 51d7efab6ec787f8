#include "adapter.h"

#include <ggml.h>
#include <gguf.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace saca::model_host {
namespace {

constexpr const char* alpha_key = "adapter.lora.alpha";
constexpr const char* type_key = "general.file_type";
constexpr std::uint32_t mostly_f16 = 1;  // as llama.h has it: LLAMA_FTYPE_MOSTLY_F16
constexpr const char* base_key = "saca.base.sha256";
constexpr std::string_view first_half = ".lora_a";
constexpr std::string_view second_half = ".lora_b";

/// A GGUF file with its tensors in memory.
class GgufFile {
 public:
  static Result<GgufFile> read(const std::string& path) {
    GgufFile file;
    ggml_context* tensors = nullptr;
    file.about_.reset(gguf_init_from_file(path.c_str(), {.no_alloc = false, .ctx = &tensors}));
    file.tensors_.reset(tensors);
    if (!file.about_ || tensors == nullptr) {
      return Error{Error::Code::unreadable, path + ": want a GGUF file, cannot read it as one"};
    }
    return file;
  }

  [[nodiscard]] const gguf_context* about() const { return about_.get(); }
  [[nodiscard]] std::vector<ggml_tensor*> tensors() const {
    std::vector<ggml_tensor*> all;
    for (std::int64_t i = 0; i < gguf_get_n_tensors(about()); ++i) {
      all.push_back(tensor(gguf_get_tensor_name(about(), i)));
    }
    return all;
  }
  [[nodiscard]] ggml_tensor* tensor(const std::string& name) const {
    return ggml_get_tensor(tensors_.get(), name.c_str());
  }
  /// Empty: it is not told, or no text.
  [[nodiscard]] std::string text(const char* key) const {
    const std::int64_t at = gguf_find_key(about(), key);
    return at < 0 || gguf_get_kv_type(about(), at) != GGUF_TYPE_STRING
               ? ""
               : gguf_get_val_str(about(), at);
  }
  [[nodiscard]] std::optional<float> number(const char* key) const {
    const std::int64_t at = gguf_find_key(about(), key);
    return at < 0 || gguf_get_kv_type(about(), at) != GGUF_TYPE_FLOAT32
               ? std::nullopt
               : std::optional(gguf_get_val_f32(about(), at));
  }

 private:
  struct Free {
    void operator()(gguf_context* about) const { gguf_free(about); }
    void operator()(ggml_context* tensors) const { ggml_free(tensors); }
  };
  std::unique_ptr<gguf_context, Free> about_;
  std::unique_ptr<ggml_context, Free> tensors_;
};

/// One matrix's pair.
struct Pair {
  const ggml_tensor* a = nullptr;  ///< [r, n]
  const ggml_tensor* b = nullptr;  ///< [m, r]
};

/// Whether ggml has its numbers as floats: of integers and doubles it does not.
bool has_values(const ggml_tensor& tensor) {
  return tensor.type == GGML_TYPE_F32 || ggml_get_type_traits(tensor.type)->to_float != nullptr;
}

/// @param tensor  that has_values()
std::vector<float> values(const ggml_tensor& tensor) {
  std::vector<float> all(static_cast<std::size_t>(ggml_nelements(&tensor)));
  if (tensor.type == GGML_TYPE_F32) {
    const auto* begin = static_cast<const float*>(tensor.data);
    all.assign(begin, begin + all.size());
  } else {
    ggml_get_type_traits(tensor.type)
        ->to_float(tensor.data, all.data(), static_cast<std::int64_t>(all.size()));
  }
  return all;
}

std::string shape(const ggml_tensor* tensor) {
  return tensor == nullptr ? "none"
                           : std::to_string(tensor->ne[1]) + " x " + std::to_string(tensor->ne[0]);
}

/// The adapter's pairs by the name of the matrix that they belong to, all of which have values.
Result<std::map<std::string, Pair>> pairs_of(const GgufFile& adapter, const GgufFile& base,
                                             const std::string& path) {
  std::map<std::string, Pair> pairs;
  for (const ggml_tensor* one : adapter.tensors()) {
    const std::string_view name = one->name;
    if (!has_values(*one)) {
      return Error{Error::Code::malformed, path + ": " + one->name +
                                               ": want floating-point or quantised numbers, got " +
                                               ggml_type_name(one->type)};
    }
    if (name.ends_with(first_half)) {
      pairs[std::string(name.substr(0, name.size() - first_half.size()))].a = one;
    } else if (name.ends_with(second_half)) {
      pairs[std::string(name.substr(0, name.size() - second_half.size()))].b = one;
    } else {
      return Error{Error::Code::malformed,
                   path + ": " + one->name + ": want names that end with .lora_a or .lora_b"};
    }
  }
  for (const auto& [name, pair] : pairs) {
    const ggml_tensor* of = base.tensor(name);
    const bool fits = of != nullptr && pair.a != nullptr && pair.b != nullptr &&
                      pair.a->ne[0] == of->ne[0] && pair.b->ne[1] == of->ne[1] &&
                      pair.a->ne[1] == pair.b->ne[0];
    if (!fits) {
      return Error{Error::Code::malformed,
                   path + ": " + name + ": want r x n and m x r for an m x n matrix of the base, " +
                       "got " + shape(pair.a) + " and " + shape(pair.b) + " for " + shape(of)};
    }
    if (!has_values(*of)) {
      return Error{Error::Code::malformed,
                   path + ": " + name +
                       ": want a matrix of floating-point or quantised numbers in " +
                       "the base, got " + ggml_type_name(of->type)};
    }
  }
  if (pairs.empty()) {
    return Error{Error::Code::malformed, path + ": want matrices, got none"};
  }
  return pairs;
}

/// W + scale B A, as 16-bit numbers.
std::vector<ggml_fp16_t> merged(const ggml_tensor& weights, const Pair& pair, float alpha) {
  const auto columns = static_cast<std::size_t>(weights.ne[0]);
  const auto rows = static_cast<std::size_t>(weights.ne[1]);
  const auto rank = static_cast<std::size_t>(pair.a->ne[1]);
  std::vector<float> sum = values(weights);
  const std::vector<float> a = values(*pair.a);
  const std::vector<float> b = values(*pair.b);
  const float scale = alpha / static_cast<float>(rank);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = 0; k < rank; ++k) {
      const float factor = scale * b[row * rank + k];
      for (std::size_t column = 0; column < columns; ++column) {
        sum[row * columns + column] += factor * a[k * columns + column];
      }
    }
  }
  std::vector<ggml_fp16_t> result(sum.size());
  ggml_fp32_to_fp16_row(sum.data(), result.data(), static_cast<std::int64_t>(sum.size()));
  return result;
}

}  // namespace

std::optional<Error> merge_adapter(const std::string& base, std::string_view base_sha256,
                                   const std::string& adapter, const std::string& out) {
  const auto weights = GgufFile::read(base);
  if (!weights.has_value()) {
    return weights.error();
  }
  const auto added = GgufFile::read(adapter);
  if (!added.has_value()) {
    return added.error();
  }
  const std::optional<float> alpha = added.value().number(alpha_key);
  if (added.value().text("general.type") != "adapter" ||
      added.value().text("adapter.type") != "lora" || !alpha) {
    return Error{
        Error::Code::malformed,
        adapter + ": want an adapter (general.type adapter, adapter.type lora, " + alpha_key + ")"};
  }
  if (added.value().text(base_key) != base_sha256) {
    return Error{Error::Code::malformed, adapter + ": want an adapter of " + base + " (sha256 " +
                                             std::string(base_sha256) + "), got one of `" +
                                             added.value().text(base_key) + "`"};
  }
  const auto pairs = pairs_of(added.value(), weights.value(), adapter);
  if (!pairs.has_value()) {
    return pairs.error();
  }
  const std::unique_ptr<gguf_context, decltype(&gguf_free)> result(gguf_init_empty(), gguf_free);
  gguf_set_kv(result.get(), weights.value().about());
  gguf_set_val_u32(result.get(), type_key, mostly_f16);
  std::vector<std::vector<ggml_fp16_t>> kept;  // what the file points to, until it is written
  for (const ggml_tensor* one : weights.value().tensors()) {
    gguf_add_tensor(result.get(), one);
    if (const auto pair = pairs.value().find(one->name); pair != pairs.value().end()) {
      kept.push_back(merged(*one, pair->second, *alpha));
      gguf_set_tensor_type(result.get(), one->name, GGML_TYPE_F16);
      gguf_set_tensor_data(result.get(), one->name, kept.back().data());
    }
  }
  const std::string unfinished = out + ".part";
  std::error_code problem;
  if (gguf_write_to_file(result.get(), unfinished.c_str(), false)) {
    std::filesystem::rename(unfinished, out, problem);
  } else {
    problem = std::make_error_code(std::errc::io_error);
  }
  if (problem) {
    return Error{Error::Code::unwritable, out + ": cannot be written"};
  }
  return std::nullopt;
}

}  // namespace saca::model_host
