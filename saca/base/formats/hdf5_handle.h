#pragma once

#include <hdf5.h>

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "saca/base/core/contract.h"

/// What writer and reader of HDF5 share. Not part of the module's interface.
namespace saca::formats {

/// The serial library works for one thread at a time; its own messages are kept quiet meanwhile.
class Hdf5Session {
 public:
  Hdf5Session() : lock_(mutex()) {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Session() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Hdf5Session(const Hdf5Session&) = delete;
  Hdf5Session& operator=(const Hdf5Session&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex only;
    return only;
  }
  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (good()) {
      close_(id_);
    }
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;

  [[nodiscard]] bool good() const { return id_ >= 0; }
  [[nodiscard]] hid_t id() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// @param growth  bytes at a time
inline Hdf5Handle memory_file_access(std::size_t growth) {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.id(), growth, 0);
  return access;
}

/// Nobody else is locked out: a file is put in its place whole, and never changed there.
inline Hdf5Handle without_lock() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.id(), false, true);
  return access;
}

template <class Real>
hid_t file_type() {
  return sizeof(Real) == sizeof(double) ? H5T_IEEE_F64LE : H5T_IEEE_F32LE;
}
template <class Real>
hid_t memory_type() {
  return sizeof(Real) == sizeof(double) ? H5T_NATIVE_DOUBLE : H5T_NATIVE_FLOAT;
}

/// One part after another along the first axis of a data set.
class Hdf5Parts {
 public:
  Hdf5Parts(const std::vector<std::size_t>& extents, std::size_t num_parts)
      : count_(extents.begin(), extents.end()), start_(extents.size(), 0) {
    expects(num_parts > 0 && !extents.empty() && extents[0] % num_parts == 0,
            "the first extent is divided among the parts");
    count_[0] /= num_parts;
  }
  /// What lies in memory for one.
  [[nodiscard]] Hdf5Handle space() const {
    return {H5Screate_simple(static_cast<int>(count_.size()), count_.data(), nullptr), H5Sclose};
  }
  [[nodiscard]] std::size_t size() const {
    std::size_t size = 1;
    for (const hsize_t extent : count_) {
      size *= extent;
    }
    return size;
  }
  /// Selects the next in the data set's space.
  bool select_next(const Hdf5Handle& space) {
    const bool selected = H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start_.data(), nullptr,
                                              count_.data(), nullptr) >= 0;
    start_[0] += count_[0];
    return selected;
  }

 private:
  std::vector<hsize_t> count_, start_;
};

}  // namespace saca::formats
