#include <fcntl.h>
#include <fmt/compile.h>
#include <fmt/format.h>
#include <matio.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "logs/log_sources.hpp"
#include "text/located_text.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostNumbers = std::size_t{1} << 27;  // of one file: 1 GiB
constexpr std::size_t kLargestText = std::size_t{2} << 30;
constexpr rlim_t kSeconds = 120;

struct MatColumn {
  std::string name;
  std::vector<double> values;
};

struct Found {
  std::vector<MatColumn> columns;
  std::map<std::size_t, std::vector<std::string>> names;  // cell arrays of texts, by their length
  std::size_t numbers = 0;
};

std::size_t count_of(const matvar_t* variable) {
  std::size_t count = 1;
  for (int k = 0; k < variable->rank; ++k) {
    const std::size_t size = variable->dims[k];
    if (size != 0 && count > kMostNumbers / size) return kMostNumbers + 1;
    count *= size;
  }
  return count;
}

template <class Number>
void append(const void* data, std::size_t begin, std::size_t end, std::vector<double>& to) {
  const auto* const values = static_cast<const Number*>(data);
  for (std::size_t i = begin; i < end; ++i) to.push_back(static_cast<double>(values[i]));
}

bool append_numbers(const matvar_t* variable, std::size_t begin, std::size_t end, std::vector<double>& to) {
  using Append = void (*)(const void* data, std::size_t begin, std::size_t end, std::vector<double>& to);
  constexpr std::pair<matio_types, Append> kTypes[] = {
      {MAT_T_DOUBLE, append<double>},      {MAT_T_SINGLE, append<float>},
      {MAT_T_INT8, append<std::int8_t>},   {MAT_T_UINT8, append<std::uint8_t>},
      {MAT_T_INT16, append<std::int16_t>}, {MAT_T_UINT16, append<std::uint16_t>},
      {MAT_T_INT32, append<std::int32_t>}, {MAT_T_UINT32, append<std::uint32_t>},
      {MAT_T_INT64, append<std::int64_t>}, {MAT_T_UINT64, append<std::uint64_t>}};
  const auto* const type = std::find_if(std::begin(kTypes), std::end(kTypes),
                                        [&](const auto& one) { return one.first == variable->data_type; });
  if (type == std::end(kTypes)) return false;
  type->second(variable->data, begin, end, to);
  return true;
}

std::string text_of(const matvar_t* variable) {
  std::string text;
  if (variable == nullptr || variable->class_type != MAT_C_CHAR || variable->data == nullptr) return text;
  const std::size_t size = std::min<std::size_t>(count_of(variable), 200);
  for (std::size_t i = 0; i < size; ++i) {
    const bool wide = variable->data_type == MAT_T_UINT16 || variable->data_type == MAT_T_UTF16;
    const unsigned code = wide ? static_cast<const std::uint16_t*>(variable->data)[i]
                               : static_cast<const unsigned char*>(variable->data)[i];
    if (wide)
      append_utf8(text, code);
    else
      text += static_cast<char>(code);
  }
  return text;
}

void take(const matvar_t* variable, const std::string& name, int depth, Found& found);

void take_fields(matvar_t* variable, int depth, Found& found) {
  if (count_of(variable) != 1) return;  // an array of structs
  const unsigned fields = Mat_VarGetNumberOfFields(variable);
  char* const* const names = Mat_VarGetStructFieldnames(variable);
  for (unsigned k = 0; k < fields && names != nullptr; ++k) {
    const matvar_t* const field = Mat_VarGetStructFieldByIndex(variable, k, 0);
    if (field != nullptr) take(field, names[k], depth - 1, found);
  }
}

void take(const matvar_t* variable, const std::string& name, int depth, Found& found) {
  if (variable->class_type == MAT_C_STRUCT && depth > 0)
    return take_fields(const_cast<matvar_t*>(variable), depth, found);
  const std::size_t count = count_of(variable);
  if (variable->class_type == MAT_C_CELL && variable->data != nullptr && count < kMostColumns) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < count; ++i) texts.push_back(text_of(static_cast<matvar_t* const*>(variable->data)[i]));
    const bool all = std::none_of(texts.begin(), texts.end(), [](const std::string& text) { return text.empty(); });
    if (all && count > 1) found.names.emplace(count, std::move(texts));
    return;
  }
  if (variable->rank != 2 || variable->isComplex || variable->data == nullptr || count < 2) return;
  if (found.numbers + count > kMostNumbers) throw Error("at most 134 217 728 numbers, found more");
  const bool row = variable->dims[0] == 1;
  const std::size_t rows = row ? count : variable->dims[0], columns = row ? 1 : variable->dims[1];
  if (columns > kMostColumns) return;
  for (std::size_t k = 0; k < columns; ++k) {
    MatColumn column{columns == 1 ? name : fmt::format("{}_{}", name, k + 1), {}};
    column.values.reserve(rows);
    if (!append_numbers(variable, k * rows, (k + 1) * rows, column.values)) return;
    found.columns.push_back(std::move(column));
  }
  found.numbers += count;
  if (columns > 1) {
    const auto names = found.names.find(columns);
    if (names == found.names.end()) return;
    for (std::size_t k = 0; k < columns; ++k) found.columns[found.columns.size() - columns + k].name = names->second[k];
  }
}

// The table as text; throws Error with what was expected and found, without the file's name.
std::string text_of_file(const std::string& path) {
  // Names first: they may stand behind the matrix that they name.
  Found found;
  std::size_t variables = 0;
  for (const bool names : {true, false}) {
    // Opened twice: matio goes back to the start of a v5 file alone.
    const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(Mat_Open(path.c_str(), MAT_ACC_RDONLY), &Mat_Close);
    if (!file) throw Error("a whole .mat file, found a damaged one");
    for (;;) {
      const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> info(Mat_VarReadNextInfo(file.get()), &Mat_VarFree);
      if (!info) break;
      ++variables;
      if ((info->class_type == MAT_C_CELL) != names || info->name == nullptr) continue;
      if (count_of(info.get()) > kMostNumbers) throw Error("at most 134 217 728 numbers, found more");
      const std::string name = info->name;
      if (Mat_VarReadDataAll(file.get(), info.get()) != 0) continue;
      take(info.get(), name, 3, found);
    }
  }
  if (variables == 0) throw Error("a whole .mat file, found a damaged one");
  std::map<std::size_t, std::size_t> lengths;
  for (const MatColumn& column : found.columns) ++lengths[column.values.size()];
  std::size_t rows = 0, most = 0;
  for (const auto& [length, count] : lengths) {
    if (count >= most) rows = length, most = count;
  }
  std::erase_if(found.columns, [&](const MatColumn& column) { return column.values.size() != rows; });
  if (found.columns.size() < 2) throw Error("at least two vectors of the same length, found fewer");
  std::string text;
  for (const MatColumn& column : found.columns) text += (text.empty() ? "" : "\t") + as_cell(column.name);
  for (std::size_t row = 0; row < rows; ++row) {
    text += '\n';
    for (const MatColumn& column : found.columns) {
      if (&column != &found.columns.front()) text += '\t';
      if (std::isfinite(column.values[row]))
        fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), column.values[row]);
    }
    if (text.size() > kLargestText) throw Error("a table of at most 2 GiB as text, found more");
  }
  return text + "\n";
}

void write_all(int to, std::string_view text) {
  while (!text.empty()) {
    const ::ssize_t count = ::write(to, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) ::_exit(3);
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

// In the child: the table with a '+' in front, or with a '-' what is wrong.
[[noreturn]] void answer(const std::string& path, int to) {
  const rlimit cpu{kSeconds, kSeconds};
  ::setrlimit(RLIMIT_CPU, &cpu);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (null >= 0) {
    ::dup2(null, STDERR_FILENO);
    ::dup2(null, STDOUT_FILENO);
  }
  std::string text;
  try {
    text = "+" + text_of_file(path);
  } catch (const std::exception& error) {
    text = fmt::format("-{}", error.what());
  }
  write_all(to, text);
  ::_exit(0);
}

struct Scratch {
  ~Scratch() {
    if (made) ::unlink(path.c_str());
  }
  std::string path = (std::filesystem::temp_directory_path() / "ballbar-mat-XXXXXX").string();
  bool made = false;
};

struct Descriptor {
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number;
};

// Of a v5 file: its elements, each with its length in front, fill it to the end. matio reads half a file as zeros.
bool is_whole(std::string_view bytes) {
  constexpr std::size_t kHeader = 128;
  if (bytes.starts_with("MATLAB 7.3")) return true;  // HDF5 sees to it
  if (bytes.size() <= kHeader + 8) return false;
  const bool little = bytes[126] == 'I' && bytes[127] == 'M';
  if (!little && !(bytes[126] == 'M' && bytes[127] == 'I')) return false;
  const auto word = [&](std::size_t at) {
    std::size_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      value = value << 8 | static_cast<unsigned char>(bytes[at + (little ? 3 - k : k)]);
    }
    return value;
  };
  std::size_t at = kHeader;
  while (at + 8 <= bytes.size()) {
    constexpr std::size_t kCompressed = 15;
    const std::size_t length = word(at + 4);
    at += 8 + (word(at) == kCompressed ? length : (length + 7) / 8 * 8);
  }
  return at == bytes.size();
}

}  // namespace

TableText mat_table(std::string_view bytes, const std::string& name) {
  if (!is_whole(bytes)) throw Error(fmt::format("{}:1: expected a whole .mat file, found a damaged one.", name));
  // HDF5 opens files by their names alone.
  Scratch scratch;
  const Descriptor file(::mkstemp(scratch.path.data()));
  scratch.made = file.number >= 0;
  int ends[2] = {-1, -1};
  if (file.number < 0 || ::pipe(ends) != 0)
    throw Error(fmt::format("{}: expected space for a copy of the file, found none.", name));
  const Descriptor from(ends[0]);
  std::string answer_text;
  int status = 0;
  {
    const Descriptor to(ends[1]);
    for (std::string_view left = bytes; !left.empty();) {
      const ::ssize_t count = ::write(file.number, left.data(), left.size());
      if (count <= 0) throw Error(fmt::format("{}: expected space for a copy of the file, found none.", name));
      left.remove_prefix(static_cast<std::size_t>(count));
    }
    const ::pid_t child = ::fork();
    if (child < 0) throw Error(fmt::format("{}: expected memory for another process, found none.", name));
    if (child == 0) answer(scratch.path, to.number);
    ::close(to.number);
    const_cast<int&>(to.number) = -1;
    char block[1 << 16];
    for (;;) {
      const ::ssize_t count = ::read(from.number, block, sizeof block);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      answer_text.append(block, static_cast<std::size_t>(count));
    }
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  }
  const bool whole = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !answer_text.empty();
  if (!whole) throw Error(fmt::format("{}:1: expected a whole .mat file, found a damaged one.", name));
  if (answer_text.front() == '-') throw Error(fmt::format("{}:1: expected {}.", name, answer_text.substr(1)));
  answer_text.erase(0, 1);
  return {std::move(answer_text), name, "a .mat file", {}};
}

}  // namespace ballbar
