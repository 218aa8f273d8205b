// Describes each type of result once. A type lists its fields: the name with its unit, the source of the value, and one
// line of meaning. The JSON is made from this list, and so is the schema, from which the types of TypeScript and the
// tables of READMEs are written (schema.hpp).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace ballbar {

// `get`: a pointer to a member of the result, or a function of the result.
template <class Get>
struct Field {
  std::string_view name;
  Get get;
  std::string_view meaning;
};
template <class Get>
Field(std::string_view, Get, std::string_view) -> Field<Get>;

// A field that a result may lack. A std::optional without value is present as null instead.
template <class Value>
struct MayLack {
  std::optional<Value> value;
};

// Values by name, in order.
template <class Value>
using TableOf = std::vector<std::pair<std::string, Value>>;

// A field whose name ends in the unit of its value: "rmse" in um becomes `rmse_um`; without a unit `rmse`.
template <class Value>
struct OfUnit {
  Value value;
  std::string unit;
};

// Values that become keys of the result itself, by names that are only known at run time.
template <class Value>
struct KeysOf {
  TableOf<Value> values;
};

// A long column of numbers with seven digits each: enough for pictures, at half the size.
struct Bulk {
  std::vector<double> values;
};

// Numbers that are always known, never null.
template <class Value>
struct Known {
  Value value;
};
template <class Type, class Value>
constexpr auto known(Value Type::*member) {
  return [member](const Type& of) { return Known<Value>{of.*member}; };
}
template <class Type, class Value>
constexpr auto known(MayLack<Value> Type::*member) {
  return [member](const Type& of) {
    return MayLack<Known<Value>>{(of.*member).value ? std::optional(Known<Value>{*(of.*member).value}) : std::nullopt};
  };
}

// What describes a type of result: its name for TypeScript and Python, and its fields in the order of the JSON. A type
// includes the fields of another by std::tuple_cat and fields_through().
template <class... Gets>
struct ResultType {
  std::string_view name, meaning;
  std::tuple<Field<Gets>...> fields;
};
template <class... Gets>
ResultType(std::string_view, std::string_view, std::tuple<Field<Gets>...>) -> ResultType<Gets...>;

// Specialised for each type of result.
template <class Type>
inline constexpr std::nullptr_t kResult = nullptr;

// The fields of a part of a result, as fields of the result.
template <class Part, class... Gets>
constexpr auto fields_through(Part part, const std::tuple<Field<Gets>...>& fields) {
  const auto through = [part](const auto& field) {
    const auto get = field.get;
    return Field{
        field.name,
        [part, get](const auto& result) -> decltype(auto) { return std::invoke(get, std::invoke(part, result)); },
        field.meaning};
  };
  return std::apply([&](const auto&... field) { return std::tuple{through(field)...}; }, fields);
}

template <class Type>
concept Described = !std::is_same_v<decltype(kResult<Type>), const std::nullptr_t>;

template <class Type>
concept Named = std::is_enum_v<Type> && requires(Type value) {
  std::string(name_of(value));
};

template <Described Type>
nlohmann::ordered_json json_of(const Type& result);

// A number that is not finite becomes null, because JSON has no such numbers.
inline nlohmann::ordered_json json_value(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}
template <std::integral Type>
nlohmann::ordered_json json_value(Type value) {
  return value;
}
inline nlohmann::ordered_json json_value(std::string_view value) { return std::string(value); }
inline nlohmann::ordered_json json_value(const std::string& value) { return value; }
template <Named Type>
nlohmann::ordered_json json_value(Type value) {
  return std::string(name_of(value));
}
template <Described Type>
nlohmann::ordered_json json_value(const Type& value) {
  return json_of(value);
}
template <class Type>
nlohmann::ordered_json json_value(const std::optional<Type>& value);
template <class Type>
nlohmann::ordered_json json_value(const TableOf<Type>& values);
template <class Type>
nlohmann::ordered_json json_value(const std::vector<Type>& values);
template <class... Types>
nlohmann::ordered_json json_value(const std::variant<Types...>& value) {
  return std::visit([](const auto& one) { return json_value(one); }, value);
}
nlohmann::ordered_json json_value(const Bulk& bulk);
template <class Value>
nlohmann::ordered_json json_value(const Known<Value>& known) {
  return json_value(known.value);
}

// Rows.
inline nlohmann::ordered_json json_value(const Eigen::MatrixXd& matrix) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(json_value(matrix(i, j)));
    rows.push_back(std::move(row));
  }
  return rows;
}

template <class Type>
nlohmann::ordered_json json_value(const std::optional<Type>& value) {
  return value ? json_value(*value) : nlohmann::ordered_json(nullptr);
}
template <class Type>
nlohmann::ordered_json json_value(const TableOf<Type>& values) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [key, value] : values) json[key] = json_value(value);
  return json;
}
template <class Type>
nlohmann::ordered_json json_value(const std::vector<Type>& values) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Type& value : values) json.push_back(json_value(value));
  return json;
}

// Adds the field to `json` if the result has it.
template <class Value>
void add_value(nlohmann::ordered_json& json, std::string_view name, const Value& value) {
  json[std::string(name)] = json_value(value);
}
template <class Value>
void add_value(nlohmann::ordered_json& json, std::string_view name, const MayLack<Value>& value) {
  if (value.value) add_value(json, name, *value.value);
}
template <class Value>
void add_value(nlohmann::ordered_json& json, std::string_view name, const OfUnit<Value>& value) {
  add_value(json, value.unit.empty() ? std::string(name) : std::string(name) + "_" + value.unit, value.value);
}
template <class Value>
void add_value(nlohmann::ordered_json& json, std::string_view, const KeysOf<Value>& keys) {
  for (const auto& [key, value] : keys.values) add_value(json, key, value);
}

template <Described Type>
nlohmann::ordered_json json_of(const Type& result) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  std::apply([&](const auto&... field) { (add_value(json, field.name, std::invoke(field.get, result)), ...); },
             kResult<Type>.fields);
  return json;
}

}  // namespace ballbar
