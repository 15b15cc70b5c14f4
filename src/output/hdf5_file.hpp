#pragma once
/// The few things the project wants from HDF5, with handles that close themselves. Errors become
/// InputError in reading and OutputError in writing, with the name of the file; HDF5's own messages are kept quiet.
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ejecta {

/// A handle of the HDF5 library and how to close it.
class Hdf5Handle {
 public:
  using Close = int (*)(std::int64_t);
  Hdf5Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept;
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  ~Hdf5Handle();
  std::int64_t id() const { return id_; }
  /// Negative if that fails.
  int close();

 private:
  std::int64_t id_;
  Close close_;
};

/// Bytes at the front of a file that HDF5 leaves to who writes it.
inline constexpr std::size_t hdf5_user_block = 512;

/// One open file. Data sets are one-dimensional and carry a text attribute `unit`; attributes sit on the root group.
class Hdf5File {
 public:
  enum class Mode { create, read };
  Hdf5File(std::filesystem::path file, Mode mode);

  void write(const std::string& name, const std::string& unit, std::span<const double> values);
  void write(const std::string& name, const std::string& unit, std::span<const std::int32_t> values);
  void write_attribute(const std::string& name, double value);
  void write_attribute(const std::string& name, std::int64_t value);
  /// A text of any length as a data set of its own.
  void write_text(const std::string& name, const std::string& text);
  /// Hands everything to the system, the last thing to do with a file that was created; throws if the disk is full.
  void close();

  /// Names of the data sets under `group` ("/columns"), in alphabetical order; none if there is no such group.
  std::vector<std::string> names(const std::string& group) const;
  std::vector<double> read_doubles(const std::string& name) const;
  std::vector<std::int32_t> read_integers(const std::string& name) const;
  std::string unit(const std::string& name) const;
  double real_attribute(const std::string& name) const;
  std::int64_t integer_attribute(const std::string& name) const;
  std::string read_text(const std::string& name) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  Hdf5Handle checked(std::int64_t id, Hdf5Handle::Close close, const std::string& what) const;
  void write_values(const std::string& name, const std::string& unit, std::int64_t type, const void* values,
                    std::size_t count);
  template <class T>
  std::vector<T> read_values(const std::string& name, std::int64_t type) const;
  template <class T>
  void write_number(const std::string& name, std::int64_t type, T value) const;
  template <class T>
  T read_number(const std::string& name, std::int64_t type) const;

  std::filesystem::path path_;
  Mode mode_;
  Hdf5Handle file_;
};

}  // namespace ejecta
