#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace chute::read {

/// What a file holds, from its begin to its end; one that gzip or zstd packed is unpacked on the way, whatever its name. Takes
/// some megabytes, however much comes out.
class ByteStream {
 public:
  /// InputError if the file cannot be opened.
  explicit ByteStream(const std::filesystem::path& path);
  ~ByteStream();
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  /// The next bytes, valid until the next call; empty at the end. InputError if the file is cut short or damaged.
  std::string_view next();
  /// Places in a packed file are reached from its begin only.
  bool is_packed() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// Lines of a stream.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& path);
  /// The next line without its end, valid until the next call; false at the end. A last line needs no end. InputError for a line
  /// of more than `longest_line` bytes: no program writes one, and a packed file may hold one that fills the memory.
  bool next(std::string_view& line);
  /// Passes over `count` lines; how many there were.
  std::uint64_t skip(std::uint64_t count);
  std::uint64_t position() const { return position_; }  ///< bytes before the next line
  std::uint64_t number() const { return number_; }      ///< of the next line, from 1

  bool last_has_no_end() const {
    return open_;
  }  ///< the line that came last was the file's last, and no end stood behind it

  static constexpr std::size_t longest_line = 1U << 20U;

 private:
  std::filesystem::path path_;
  ByteStream stream_;
  std::string_view block_;
  std::string kept_;  ///< a line that began in an earlier block
  std::uint64_t position_ = 0, number_ = 1;
  bool open_ = false;
};

/// All that a file holds, unpacked.
std::string read_unpacked(const std::filesystem::path& path);

/// `size` bytes from place `from` on of what a file holds. Of packed files the place where the last call ended is remembered, and
/// what was read lately: pieces in rising order cost one pass together. InputError if they are not there.
std::string read_piece(const std::filesystem::path& path, std::uint64_t from, std::uint64_t size);

}  // namespace chute::read
