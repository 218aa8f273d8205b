#include "ballbar/formats/text/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/file_bytes.hpp"

namespace ballbar {

namespace {

bool is_file_on_disk(const std::filesystem::path& path) {
  std::error_code absent;
  return std::filesystem::is_regular_file(path, absent);
}

}  // namespace

// What is known of a file until it is closed.
struct Source::File {
  std::optional<OpenFile> open;
  std::optional<std::string> head;    // the first kHeadBytes, or all
  std::optional<std::string> inside;  // all bytes, of one inside an archive
};

Source::Source(const std::filesystem::path& path) : name_(path.string()), held_(std::make_shared<File>()) {}

Source::Source(std::string name, std::shared_ptr<const Series> series)
    : name_(std::move(name)), held_(std::move(series)) {}

Source::Source(std::string name, std::vector<Recording> recordings)
    : name_(std::move(name)), held_(std::make_shared<const std::vector<Recording>>(std::move(recordings))) {}

Source Source::of_text(std::string name, std::string text) {
  Source source;
  source.name_ = std::move(name);
  source.held_ = std::make_shared<const std::string>(std::move(text));
  return source;
}

const LogRecipe& Source::recipe() const {
  static const LogRecipe kNothing;
  return recipe_ == nullptr ? kNothing : *recipe_;
}

Source Source::like(const std::filesystem::path& path) const {
  Source other(path);
  other.recipe_ = recipe_;
  return other;
}

std::string Source::title() const {
  return recipe().sheet.empty() ? name_ : fmt::format("{}[{}]", name_, recipe().sheet);
}

std::shared_ptr<const Series> Source::series() const {
  const auto* const held = std::get_if<std::shared_ptr<const Series>>(&held_);
  return held == nullptr ? nullptr : *held;
}

const std::vector<Recording>* Source::recordings() const {
  const auto* const held = std::get_if<std::shared_ptr<const std::vector<Recording>>>(&held_);
  return held == nullptr ? nullptr : held->get();
}

Source::File& Source::file() const {
  if (is_path()) return *std::get<std::shared_ptr<File>>(held_);
  throw Error(fmt::format("{}: expected a file, found values.", name_));
}

const std::string* Source::text() const {
  if (const auto* const text = std::get_if<std::shared_ptr<const std::string>>(&held_)) return text->get();
  if (!is_path()) return nullptr;
  File& known = file();
  if (!known.open && !known.inside && !is_file_on_disk(name_)) known.inside = bytes_in_archive(name_, kLargestText);
  return known.inside ? &*known.inside : nullptr;
}

bool Source::is_file() const { return text() != nullptr || (is_path() && (file().open || is_file_on_disk(name_))); }

bool Source::is_archive() const {
  if (!is_path() || !is_file() || text() != nullptr) return false;
  try {
    if (head(4) != "PK\x03\x04") return false;
  } catch (const Error&) {  // not readable, which is reported where it is opened
    return false;
  }
  return ballbar::is_archive(name_);
}

const Reader* Source::reader(std::span<const Reader> readers) const {
  if (!is_file()) return nullptr;
  const auto found_by = [&](std::string_view head) {
    const Reader* reader = reader_of(head, readers);
    // Whose columns a user states is a series, even if two of them lie on a circle.
    while (!recipe().columns.empty() && read_of<ReadCircle>(reader) != nullptr) {
      readers = readers.subspan(static_cast<std::size_t>(reader - readers.data()) + 1);
      reader = reader_of(head, readers);
    }
    return reader;
  };
  if (const std::string* const whole = text()) return found_by(*whole);
  File& known = file();
  if (!known.head) known.head = head(kHeadBytes);
  return found_by(*known.head);
}

std::string Source::bytes(std::size_t limit) const {
  if (const std::string* const whole = text()) {
    if (whole->size() > limit) throw Error(fmt::format("{}: expected at most {} MiB, found more.", name_, limit >> 20));
    std::string bytes = *whole;
    close();
    return bytes;
  }
  File& known = file();
  if (!known.open) known.open.emplace(name_);
  std::string bytes = known.open->bytes(limit);
  close();
  return bytes;
}

std::string Source::head(std::size_t most) const {
  std::string bytes(most, '\0');
  bytes.resize(read(0, bytes.data(), most));
  return bytes;
}

std::size_t Source::read(std::size_t offset, char* to, std::size_t most) const {
  if (const std::string* const whole = text()) {
    const std::size_t count = std::min(most, whole->size() - std::min(offset, whole->size()));
    whole->copy(to, count, offset);
    return count;
  }
  File& known = file();
  if (!known.open) known.open.emplace(name_);
  return known.open->read(offset, to, most);
}

std::size_t Source::size() const {
  if (const std::string* const whole = text()) return whole->size();
  File& known = file();
  if (!known.open) known.open.emplace(name_);
  return known.open->size();
}

void Source::close() const {
  if (!is_path()) return;
  File& known = file();
  known.open.reset();
  known.head.reset();
  known.inside.reset();
}

std::vector<std::string> names_of(const std::vector<Source>& sources) {
  std::vector<std::string> names;
  names.reserve(sources.size());
  for (const Source& source : sources) names.push_back(source.name());
  return names;
}

std::vector<std::filesystem::path> paths_of(const std::vector<Source>& sources) {
  std::vector<std::filesystem::path> paths;
  for (const Source& source : sources) {
    if (source.is_path()) paths.push_back(source.path());
  }
  return paths;
}

void expect_once(const std::vector<Source>& sources) {
  for (auto source = sources.begin(); source != sources.end(); ++source) {
    const auto before = std::find_if(sources.begin(), source, [&](const Source& other) {
      std::error_code absent;  // told where it is opened
      return source->is_path() && other.is_path() && source->recipe().sheet == other.recipe().sheet &&
             std::filesystem::equivalent(source->path(), other.path(), absent);
    });
    if (before == source) continue;
    throw Error(fmt::format("{}: expected each file once, found it again{}.", source->name(),
                            before->name() == source->name() ? "" : fmt::format(", the same as {}", before->name())));
  }
}

}  // namespace ballbar
