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

#include "ballbar/formats/results/schema.hpp"

namespace ballbar {

// `get`: a pointer to a member of the result, or a function of the result.
template <class Get>
struct Field {
  std::string_view name;
  Get get;
  std::string_view meaning = "";
};
template <class Get>
Field(std::string_view, Get) -> Field<Get>;
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
  std::string_view unit;
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

template <class Type>
inline constexpr bool kIsOptional = false;
template <class Value>
inline constexpr bool kIsOptional<std::optional<Value>> = true;

// The `get` of a field that is a member of a part: in(&OwnValue::interval, &Interval::low). Null without that part.
template <class Get>
constexpr Get in(Get get) {
  return get;
}
template <class Part, class... Rest>
constexpr auto in(Part part, Rest... rest) {
  return [part, get = in(rest...)](const auto& result) -> decltype(auto) {
    using Of = std::invoke_result_t<const Part&, decltype(result)>;
    if constexpr (kIsOptional<std::remove_cvref_t<Of>>) {
      const auto& of = std::invoke(part, result);
      using Value = std::remove_cvref_t<decltype(std::invoke(get, *of))>;
      using Null = std::conditional_t<kIsOptional<Value>, Value, std::optional<Value>>;
      return of ? Null(std::invoke(get, *of)) : Null();
    } else if constexpr (std::is_lvalue_reference_v<Of>) {
      return std::invoke(get, std::invoke(part, result));
    } else {
      const auto of = std::invoke(part, result);
      return std::remove_cvref_t<decltype(std::invoke(get, of))>(std::invoke(get, of));
    }
  };
}

// Of a field that is lacking where its value is null or empty, and of one that is there where `is_so`.
template <class Get>
constexpr auto may_lack(Get get) {
  return [get](const auto& result) {
    const auto& value = std::invoke(get, result);
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (kIsOptional<Value>) {
      return MayLack<typename Value::value_type>{value};
    } else if constexpr (requires { value.empty(); }) {
      return MayLack<Value>{value.empty() ? std::nullopt : std::optional(value)};
    } else {
      return Value(value);
    }
  };
}
template <class Is, class Get>
constexpr auto where(Is is_so, Get get) {
  return [is_so, get](const auto& result) {
    using Value = std::remove_cvref_t<decltype(std::invoke(get, result))>;
    MayLack<Value> field;
    if (std::invoke(is_so, result)) field.value.emplace(std::invoke(get, result));
    return field;
  };
}

// Of how many a list has, of a long one, of numbers that are known, and of a value with the unit of the result.
template <class Get>
constexpr auto count(Get get) {
  return [get](const auto& result) { return std::invoke(get, result).size(); };
}
template <class Get>
constexpr auto bulk(Get get) {
  return [get](const auto& result) { return Bulk{std::invoke(get, result)}; };
}
template <class Value>
Known<Value> known_value(const Value& value) {
  return {value};
}
template <class Value>
MayLack<Known<Value>> known_value(const MayLack<Value>& lacking) {
  return {lacking.value ? std::optional(Known<Value>{*lacking.value}) : std::nullopt};
}
template <class Get>
constexpr auto known(Get get) {
  return [get](const auto& result) { return known_value(std::invoke(get, result)); };
}
template <class Get>
constexpr auto with_unit(Get get) {
  return [get](const auto& result) {
    return OfUnit<std::remove_cvref_t<decltype(std::invoke(get, result))>>{std::invoke(get, result), result.unit};
  };
}

// The fields of a result as they are, and one as a list of them.
template <class... Gets>
constexpr std::tuple<Field<Gets>...> fields_of(const std::tuple<Field<Gets>...>& fields) {
  return fields;
}
template <class Get>
constexpr std::tuple<Field<Get>> fields_of(const Field<Get>& field) {
  return {field};
}

// What describes a type of result: its name for TypeScript and Python, and its fields in the order of the JSON.
// `parts`: fields, and lists of them; of two of the same name the later one counts, in the place of the first.
template <class Fields>
struct ResultType {
  std::string_view name, meaning;
  Fields fields;

  template <class... Parts>
  constexpr ResultType(std::string_view the_name, std::string_view the_meaning, const Parts&... parts)
      : name(the_name), meaning(the_meaning), fields(std::tuple_cat(fields_of(parts)...)) {}
};
template <class... Parts>
ResultType(std::string_view, std::string_view, const Parts&...)
    -> ResultType<decltype(std::tuple_cat(fields_of(std::declval<const Parts&>())...))>;

// Specialised for each type of result.
template <class Type>
inline constexpr std::nullptr_t kResult = nullptr;

// The fields of a part of a result, as fields of the result: all that describe it, or these.
template <class Type, class Part>
constexpr auto fields_of(Part Type::*part) {
  return fields_of(part, kResult<Part>.fields);
}
template <class Part, class... Of>
requires(sizeof...(Of) > 0) constexpr auto fields_of(Part part, const Of&... of) {
  const auto through = [part](const auto& field) { return Field{field.name, in(part, field.get), field.meaning}; };
  return std::apply([&](const auto&... field) { return std::tuple{through(field)...}; },
                    std::tuple_cat(fields_of(of)...));
}

// Of several targets, each as of one.
template <class Type>
struct Targets {
  std::vector<Type> targets;
};
template <class Type>
inline constexpr std::string_view kTargetsName;
template <class Type>
inline constexpr auto kResult<Targets<Type>> = ResultType(kTargetsName<Type>, "Results of several targets.",
                                                          Field{"targets", &Targets<Type>::targets, "each as of one"});

template <class Type>
concept Described = !std::is_same_v<decltype(kResult<Type>), const std::nullptr_t>;

template <class Type>
concept Named = std::is_enum_v<Type> && requires(Type value) {
  std::string(name_of(value));
};

using Json = nlohmann::ordered_json;
template <Described Type>
Json json_of(const Type& result);
// Adds the type, and after it the types of its fields, each once. Throws Error if two types have the same name.
template <Described Type>
void add_schema(std::vector<ResultSchema>& all);

// How a value is written, and its type, which may add those that it refers to. A number that is not finite is null,
// because JSON has no such numbers.
template <class Value>
struct ValueOf {
  static Json json(const Value& value) {
    if constexpr (Described<Value>) {
      return json_of(value);
    } else if constexpr (Named<Value>) {
      return std::string(name_of(value));
    } else if constexpr (std::floating_point<Value>) {
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    } else if constexpr (std::integral<Value>) {
      return value;
    } else {
      return std::string(value);
    }
  }
  static ValueSchema schema(std::vector<ResultSchema>& all) {
    if constexpr (Described<Value>) {
      add_schema<Value>(all);
      return {ValueKind::result, false, std::string(kResult<Value>.name)};
    } else if constexpr (std::floating_point<Value>) {
      return {ValueKind::number};
    } else if constexpr (std::integral<Value>) {
      return {std::same_as<Value, bool> ? ValueKind::truth : ValueKind::whole};
    } else {
      static_assert(std::convertible_to<Value, std::string_view> || Named<Value>);
      return {ValueKind::text};
    }
  }
};
template <class Value>
Json json_value(const Value& value) {
  return ValueOf<Value>::json(value);
}
template <class Value>
struct ValueOf<std::optional<Value>> {
  static Json json(const std::optional<Value>& value) { return value ? json_value(*value) : Json(nullptr); }
  static ValueSchema schema(std::vector<ResultSchema>& all) {
    ValueSchema schema = ValueOf<Value>::schema(all);
    schema.or_null = true;
    return schema;
  }
};
template <class Value>
struct ValueOf<std::vector<Value>> {
  static Json json(const std::vector<Value>& values) {
    Json json = Json::array();
    for (const Value& value : values) json.push_back(json_value(value));
    return json;
  }
  static ValueSchema schema(std::vector<ResultSchema>& all) {
    return {ValueKind::list, false, "", {ValueOf<Value>::schema(all)}};
  }
};
template <class Value>
struct ValueOf<TableOf<Value>> {
  static Json json(const TableOf<Value>& values) {
    Json json = Json::object();
    for (const auto& [key, value] : values) json[key] = json_value(value);
    return json;
  }
  static ValueSchema schema(std::vector<ResultSchema>& all) {
    return {ValueKind::table, false, "", {ValueOf<Value>::schema(all)}};
  }
};
template <class... Types>
struct ValueOf<std::variant<Types...>> {
  static Json json(const std::variant<Types...>& value) {
    return std::visit([](const auto& one) { return json_value(one); }, value);
  }
  static ValueSchema schema(std::vector<ResultSchema>& all) {
    return {ValueKind::one_of, false, "", {ValueOf<Types>::schema(all)...}};
  }
};
template <class Value>
struct ValueOf<Known<Value>> {
  static Json json(const Known<Value>& known) { return json_value(known.value); }
  static ValueSchema schema(std::vector<ResultSchema>& all) {
    ValueSchema schema = ValueOf<Value>::schema(all);
    (schema.of.empty() ? schema : schema.of.front()).kind = ValueKind::known;
    return schema;
  }
};
template <>
struct ValueOf<Bulk> : ValueOf<std::vector<double>> {
  static Json json(const Bulk& bulk);
};
template <>
struct ValueOf<Eigen::MatrixXd> : ValueOf<std::vector<std::vector<double>>> {
  static Json json(const Eigen::MatrixXd& matrix);  // rows
};

// The keys that a field becomes: adds them to `json` if the result has them, and to the fields of a schema.
template <class Value>
struct KeyOf {
  static void add(Json& json, std::string_view name, const Value& value) {
    json[std::string(name)] = json_value(value);
  }
  static void describe(FieldSchema field, std::vector<FieldSchema>& fields, std::vector<ResultSchema>& all) {
    field.value = ValueOf<Value>::schema(all);
    add_field(fields, std::move(field));
  }
};
template <class Value>
struct KeyOf<MayLack<Value>> {
  static void add(Json& json, std::string_view name, const MayLack<Value>& value) {
    if (value.value) KeyOf<Value>::add(json, name, *value.value);
  }
  static void describe(FieldSchema field, std::vector<FieldSchema>& fields, std::vector<ResultSchema>& all) {
    if (field.key == KeyKind::always) field.key = KeyKind::may_lack;
    KeyOf<Value>::describe(std::move(field), fields, all);
  }
};
template <class Value>
struct KeyOf<OfUnit<Value>> {
  static void add(Json& json, std::string_view name, const OfUnit<Value>& value) {
    std::string key(name);
    if (!value.unit.empty()) key.append("_").append(value.unit);
    KeyOf<Value>::add(json, key, value.value);
  }
  static void describe(FieldSchema field, std::vector<FieldSchema>& fields, std::vector<ResultSchema>& all) {
    field.key = KeyKind::with_unit;
    KeyOf<Value>::describe(std::move(field), fields, all);
  }
};
template <class Value>
struct KeyOf<KeysOf<Value>> {
  static void add(Json& json, std::string_view, const KeysOf<Value>& keys) {
    for (const auto& [key, value] : keys.values) KeyOf<Value>::add(json, key, value);
  }
  static void describe(FieldSchema field, std::vector<FieldSchema>& fields, std::vector<ResultSchema>& all) {
    field.key = KeyKind::made;
    KeyOf<Value>::describe(std::move(field), fields, all);
  }
};

// Calls `visit` with each field of a result and the KeyOf of its value.
template <Described Type, class Visit>
void for_each_field(const Visit& visit) {
  const auto of = [&](const auto& field) {
    visit(field, KeyOf<std::remove_cvref_t<std::invoke_result_t<decltype(field.get), const Type&>>>());
  };
  std::apply([&](const auto&... field) { (of(field), ...); }, kResult<Type>.fields);
}

template <Described Type>
Json json_of(const Type& result) {
  Json json = Json::object();
  for_each_field<Type>([&](const auto& field, auto key) { key.add(json, field.name, std::invoke(field.get, result)); });
  return json;
}

template <Described Type>
void add_schema(std::vector<ResultSchema>& all) {
  const std::size_t place = all.size();  // at once: a field may be of the type itself
  if (!add_name(all, {std::string(kResult<Type>.name), std::string(kResult<Type>.meaning), {}, &kResult<Type>.fields}))
    return;
  std::vector<FieldSchema> fields;
  for_each_field<Type>([&](const auto& field, auto key) {
    key.describe({std::string(field.name), std::string(field.meaning), {}}, fields, all);
  });
  all[place].fields = std::move(fields);
}

}  // namespace ballbar
