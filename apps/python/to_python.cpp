#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "python/arrays.hpp"
#include "python/classes.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

constexpr std::size_t kShort = 32;  // names, units, verdicts: the same words again and again

bool are_numbers(const Json& json) {
  const auto is_number = [](const Json& one) { return one.is_number() || one.is_null(); };
  return !json.empty() && std::all_of(json.begin(), json.end(), is_number);
}

class Converter {
 public:
  explicit Converter(Columns columns) : columns_(columns) {}

  py::object of(const Json& json) {
    switch (json.type()) {
      case Json::value_t::object: {
        py::dict dict;
        for (auto one = json.begin(); one != json.end(); ++one) {
          if (PyDict_SetItem(dict.ptr(), text(one.key()).ptr(), of(*one).ptr()) != 0) throw py::error_already_set();
        }
        return dict;
      }
      case Json::value_t::array: {
        if (columns_ == Columns::arrays && are_numbers(json)) return array(json);
        py::list list(json.size());
        Py_ssize_t i = 0;
        for (const Json& value : json) PyList_SET_ITEM(list.ptr(), i++, of(value).release().ptr());
        return list;
      }
      case Json::value_t::string:
        return text(json.get_ref<const std::string&>());
      case Json::value_t::boolean:
        return py::bool_(json.get<bool>());
      case Json::value_t::number_integer:
        return py::int_(json.get<std::int64_t>());
      case Json::value_t::number_unsigned:
        return py::int_(json.get<std::uint64_t>());
      case Json::value_t::number_float:
        return py::float_(json.get<double>());
      default:
        return py::none();
    }
  }

 private:
  py::object text(const std::string& text) {
    if (text.size() > kShort) return made(text);
    py::object& known = known_[text];
    if (!known) known = made(text);
    return known;
  }

  static py::object array(const Json& json) {
    std::vector<double> values;
    values.reserve(json.size());
    for (const Json& one : json) values.push_back(one.is_null() ? std::nan("") : one.get<double>());
    return array_of(std::move(values));
  }

  static py::object made(const std::string& text) {
    auto object = py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
    if (!object) throw py::error_already_set();
    return object;
  }

  Columns columns_;
  std::unordered_map<std::string_view, py::object> known_;  // views of the JSON's own texts
};

}  // namespace

py::object to_python(const nlohmann::ordered_json& json, Columns columns) { return Converter(columns).of(json); }

namespace {

void expect_no_signal() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace

Listener::Listener(py::handle progress) {
  caller.remark = [this](const std::string& line) { remarks.push_back(line); };
  caller.progress = [progress](std::string_view line) {
    if (line.empty()) return;  // said as a command ends, by an error too
    const py::gil_scoped_acquire hold;
    expect_no_signal();
    if (!progress.is_none()) progress(py::str(line.data(), line.size()));
  };
}

// The GIL may be another thread's: it is asked for now and then alone.
std::function<void()> Listener::signals_asked() {
  static constexpr std::chrono::milliseconds kPatience{50};
  return [asked = std::chrono::steady_clock::now()]() mutable {
    const auto now = std::chrono::steady_clock::now();
    if (now - asked < kPatience) return;
    const py::gil_scoped_acquire hold;
    expect_no_signal();
    asked = std::chrono::steady_clock::now();
  };
}

}  // namespace ballbar::python
