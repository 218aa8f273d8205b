// A source of data: a file, or values in memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/formats/text/log_recipe.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Copies share one file. It is opened on first use; bytes() and close() close it. Recognising the format and reading
// the values take one opening. A source and its copies must not be used by two threads at once.
class Source {
 public:
  Source() = default;
  // A file, a folder, or a path into an archive (archive.hpp).
  Source(const std::filesystem::path& path);                                // NOLINT(google-explicit-constructor)
  Source(const std::string& path) : Source(std::filesystem::path(path)) {}  // NOLINT(google-explicit-constructor)
  Source(const char* path) : Source(std::filesystem::path(path)) {}         // NOLINT(google-explicit-constructor)
  // Values in memory; `name` is used in messages.
  Source(std::string name, std::shared_ptr<const Series> series);
  Source(std::string name, std::vector<Recording> recordings);  // of one test
  static Source of_text(std::string name, std::string text);    // the content of a file

  [[nodiscard]] const std::string& name() const { return name_; }  // for a file its path
  [[nodiscard]] bool empty() const { return name_.empty(); }
  // The recipe of a log (log.hpp). An option that is read later may change it.
  [[nodiscard]] const LogRecipe& recipe() const;
  void set_recipe(std::shared_ptr<const LogRecipe> recipe) { recipe_ = std::move(recipe); }
  // Another file with the same recipe.
  [[nodiscard]] Source like(const std::filesystem::path& path) const;
  [[nodiscard]] std::string title() const;  // the name, with the sheet that the recipe names
  [[nodiscard]] std::filesystem::path path() const { return name_; }
  [[nodiscard]] bool is_path() const { return std::holds_alternative<std::shared_ptr<File>>(held_); }
  [[nodiscard]] std::shared_ptr<const Series> series() const;      // nullptr: something else
  [[nodiscard]] const std::vector<Recording>* recordings() const;  // nullptr: something else

  // Whether it is a regular file, one inside an archive, or a text. False for a folder, a missing file and values.
  [[nodiscard]] bool is_file() const;
  // As is_archive(path()); also false if the file cannot be opened.
  [[nodiscard]] bool is_archive() const;
  // The reader of the format, recognised by the first bytes; nullptr: unknown, or no file. Throws Error as bytes().
  [[nodiscard]] const Reader* reader(std::span<const Reader> readers = known_readers()) const;

  // All bytes. Throws Error as read_bytes().
  [[nodiscard]] std::string bytes(std::size_t limit) const;
  [[nodiscard]] std::string head(std::size_t most) const;  // the first `most` bytes, or all if fewer
  // Fewer than `most` bytes mean the end. Throws Error as read_bytes().
  std::size_t read(std::size_t offset, char* to, std::size_t most) const;
  [[nodiscard]] std::size_t size() const;
  // Closes the file; the next use opens it again.
  void close() const;

 private:
  struct File;
  [[nodiscard]] const std::string* text() const;  // bytes in memory: a text, or a file inside an archive; nullptr: none
  [[nodiscard]] File& file() const;               // throws Error for values in memory

  std::string name_;
  std::variant<std::monostate, std::shared_ptr<File>, std::shared_ptr<const std::string>, std::shared_ptr<const Series>,
               std::shared_ptr<const std::vector<Recording>>>
      held_;
  std::shared_ptr<const LogRecipe> recipe_;  // nullptr: no recipe
};

std::vector<std::string> names_of(const std::vector<Source>& sources);
std::vector<std::filesystem::path> paths_of(const std::vector<Source>& sources);  // without values in memory

// Throws Error if a file is given twice, under any name, because it would count as two measurements.
void expect_once(const std::vector<Source>& sources);

}  // namespace ballbar
