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

// What a `get` takes from a result: std::invoke, which compiles more slowly.
template <class Type, class Get>
constexpr decltype(auto) value_in(const Type& result, const Get& get) {
  if constexpr (std::is_pointer_v<Type>) {
    return value_in(*result, get);
  } else if constexpr (std::is_member_object_pointer_v<Get>) {
    return (result.*get);
  } else if constexpr (std::is_member_function_pointer_v<Get>) {
    return (result.*get)();
  } else {
    return get(result);
  }
}

// The `get` of a field that is a member of a part: in(&OwnValue::interval, &Interval::low). Null without that part.
template <class Get>
constexpr Get in(Get get) {
  return get;
}
template <class Part, class... Rest>
constexpr auto in(Part part, Rest... rest) {
  return [part, get = in(rest...)](const auto& result) -> decltype(auto) {
    using Of = decltype(value_in(result, part));
    if constexpr (kIsOptional<std::remove_cvref_t<Of>>) {
      const auto& of = value_in(result, part);
      using Value = std::remove_cvref_t<decltype(value_in(*of, get))>;
      using Null = std::conditional_t<kIsOptional<Value>, Value, std::optional<Value>>;
      return of ? Null(value_in(*of, get)) : Null();
    } else if constexpr (std::is_lvalue_reference_v<Of>) {
      return value_in(value_in(result, part), get);
    } else {
      const auto of = value_in(result, part);
      return std::remove_cvref_t<decltype(value_in(of, get))>(value_in(of, get));
    }
  };
}

// Of a field that is lacking where its value is null or empty, and of one that is there where `is_so`.
template <class Get>
constexpr auto may_lack(Get get) {
  return [get](const auto& result) {
    const auto& value = value_in(result, get);
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
    using Value = std::remove_cvref_t<decltype(value_in(result, get))>;
    MayLack<Value> field;
    if (value_in(result, is_so)) field.value.emplace(value_in(result, get));
    return field;
  };
}

// Of how many a list has, of a long one, of numbers that are known, and of a value with the unit of the result.
template <class Get>
constexpr auto count(Get get) {
  return [get](const auto& result) { return value_in(result, get).size(); };
}
template <class Get>
constexpr auto bulk(Get get) {
  return [get](const auto& result) { return Bulk{value_in(result, get)}; };
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
  return [get](const auto& result) { return known_value(value_in(result, get)); };
}
template <class Get>
constexpr auto with_unit(Get get) {
  return [get](const auto& result) {
    return OfUnit<std::remove_cvref_t<decltype(value_in(result, get))>>{value_in(result, get), result.unit};
  };
}

// Fields in the order of the JSON, each a Field or a list of them. (A std::tuple of so many types takes a third of the
// time in which the program compiles.)
template <std::size_t, class Part>
struct FieldListPart {
  Part part;
};
template <class Indices, class... Parts>
struct FieldListParts;
template <std::size_t... I, class... Parts>
struct FieldListParts<std::index_sequence<I...>, Parts...> : FieldListPart<I, Parts>... {
  constexpr explicit FieldListParts(const Parts&... parts) : FieldListPart<I, Parts>{parts}... {}

  template <class Visit>
  constexpr void each(const Visit& visit) const {
    (visit_part(static_cast<const FieldListPart<I, Parts>&>(*this).part, visit), ...);
  }

 private:
  template <class Get, class Visit>
  static constexpr void visit_part(const Field<Get>& field, const Visit& visit) {
    visit(field);
  }
  template <class List, class Visit>
  static constexpr void visit_part(const List& list, const Visit& visit) {
    list.each(visit);
  }
};
template <class... Parts>
struct FieldList : FieldListParts<std::index_sequence_for<Parts...>, Parts...> {
  constexpr explicit FieldList(const Parts&... parts)
      : FieldListParts<std::index_sequence_for<Parts...>, Parts...>(parts...) {}
};

// What describes a type of result: its name for TypeScript and Python, and its fields. Of two of the same name the
// later one counts, in the place of the first.
template <class... Parts>
struct ResultType {
  std::string_view name, meaning;
  FieldList<Parts...> fields;

  constexpr ResultType(std::string_view the_name, std::string_view the_meaning, const Parts&... parts)
      : name(the_name), meaning(the_meaning), fields(parts...) {}
};

// Specialised for each type of result.
template <class Type>
inline constexpr std::nullptr_t kResult = nullptr;

// The fields of a part of a result, as fields of the result: all that describe it, or these.
template <class Part, class List>
struct FieldsOfPart {
  Part part;
  List list;

  template <class Visit>
  constexpr void each(const Visit& visit) const {
    list.each([&](const auto& field) { visit(Field{field.name, in(part, field.get), field.meaning}); });
  }
};
template <class Part, class... Of>
requires(sizeof...(Of) > 0) constexpr auto fields_of(Part part, const Of&... of) {
  return FieldsOfPart<Part, FieldList<Of...>>{part, FieldList<Of...>(of...)};
}
template <class Type, class Part>
constexpr auto fields_of(Part Type::*part) {
  return fields_of(part, kResult<Part>.fields);
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
  kResult<Type>.fields.each([&](const auto& field) {
    visit(field, KeyOf<std::remove_cvref_t<decltype(value_in(std::declval<const Type&>(), field.get))>>());
  });
}

template <Described Type>
Json json_of(const Type& result) {
  Json json = Json::object();
  for_each_field<Type>([&](const auto& field, auto key) { key.add(json, field.name, value_in(result, field.get)); });
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
