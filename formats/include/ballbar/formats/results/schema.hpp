// The schema of the types of results, for readers of their JSON in other languages.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

enum class ValueKind {
  number,  // or null if not known
  known,   // a number
  whole,   // a whole number
  truth,   // true or false
  text,
  list,    // of `of`
  table,   // of `of` by a text
  result,  // of the type `name`
  one_of,  // these
};

struct ValueSchema {
  ValueKind kind = ValueKind::number;
  bool or_null = false;
  std::string name = {};
  std::vector<ValueSchema> of = {};
};

enum class KeyKind {
  always,
  may_lack,
  with_unit,  // NAME_UNIT
  made,       // known at run time
};

struct FieldSchema {
  std::string name, meaning;
  ValueSchema value;
  KeyKind key = KeyKind::always;
};

struct ResultSchema {
  std::string name, meaning;
  std::vector<FieldSchema> fields = {};
  const void* of = nullptr;  // the list of fields
};

// The messages of a value of sentences, which stand under a key of their own (message.hpp).
template <class Value>
struct MessagesOf {
  using Type = void;
};
std::string message_key(std::string_view name);

// Adds the type, and after it the types of its fields, each once. Throws Error if two types have the same name.
template <Described Type>
void add_schema(std::vector<ResultSchema>& all);

// The type of a value; adds the types that it refers to.
template <class Value>
struct SchemaOf {
  static ValueSchema of(std::vector<ResultSchema>& all) {
    if constexpr (std::same_as<Value, bool>) {
      return {ValueKind::truth};
    } else if constexpr (std::integral<Value>) {
      return {ValueKind::whole};
    } else if constexpr (std::floating_point<Value>) {
      return {ValueKind::number};
    } else if constexpr (Described<Value>) {
      add_schema<Value>(all);
      return {ValueKind::result, false, std::string(kResult<Value>.name)};
    } else if constexpr (std::same_as<Value, Eigen::MatrixXd>) {
      return {ValueKind::list, false, "", {{ValueKind::list, false, "", {{ValueKind::number}}}}};
    } else {
      static_assert(std::convertible_to<Value, std::string_view> || Named<Value>);
      return {ValueKind::text};
    }
  }
};
template <class Value>
struct SchemaOf<std::optional<Value>> {
  static ValueSchema of(std::vector<ResultSchema>& all) {
    ValueSchema schema = SchemaOf<Value>::of(all);
    schema.or_null = true;
    return schema;
  }
};
template <class Value>
struct SchemaOf<std::vector<Value>> {
  static ValueSchema of(std::vector<ResultSchema>& all) {
    return {ValueKind::list, false, "", {SchemaOf<Value>::of(all)}};
  }
};
template <class Value>
struct SchemaOf<TableOf<Value>> {
  static ValueSchema of(std::vector<ResultSchema>& all) {
    return {ValueKind::table, false, "", {SchemaOf<Value>::of(all)}};
  }
};

template <>
struct SchemaOf<Bulk> {
  static ValueSchema of(std::vector<ResultSchema>& all) { return SchemaOf<std::vector<double>>::of(all); }
};
template <class Value>
struct SchemaOf<Known<Value>> {
  static ValueSchema of(std::vector<ResultSchema>& all) {
    ValueSchema schema = SchemaOf<Value>::of(all);
    (schema.of.empty() ? schema : schema.of.front()).kind = ValueKind::known;
    return schema;
  }
};
template <class... Types>
struct SchemaOf<std::variant<Types...>> {
  static ValueSchema of(std::vector<ResultSchema>& all) {
    return {ValueKind::one_of, false, "", {SchemaOf<Types>::of(all)...}};
  }
};

template <class Value>
struct KeyOf {
  using Type = Value;
  static constexpr KeyKind kind = KeyKind::always;
};
template <class Value>
struct KeyOf<MayLack<Value>> {
  using Type = Value;
  static constexpr KeyKind kind = KeyKind::may_lack;
};
template <class Value>
struct KeyOf<OfUnit<Value>> {
  using Type = typename KeyOf<Value>::Type;  // it may be lacking besides
  static constexpr KeyKind kind = KeyKind::with_unit;
};
template <class Value>
struct KeyOf<KeysOf<Value>> {
  using Type = Value;
  static constexpr KeyKind kind = KeyKind::made;
};

template <Described Type>
void add_schema(std::vector<ResultSchema>& all) {
  const void* const of = &kResult<Type>.fields;
  for (const ResultSchema& one : all) {
    if (one.of == of) return;
    if (one.name == kResult<Type>.name) throw Error(one.name + ": expected one type of that name, found two.");
  }
  const std::size_t place = all.size();  // at once: a field may be of the type itself
  all.push_back({std::string(kResult<Type>.name), std::string(kResult<Type>.meaning), {}, of});
  std::vector<FieldSchema> fields;
  const auto add = [&](const auto& field) {
    using Value = std::remove_cvref_t<std::invoke_result_t<decltype(field.get), const Type&>>;
    fields.push_back({std::string(field.name), std::string(field.meaning),
                      SchemaOf<typename KeyOf<Value>::Type>::of(all), KeyOf<Value>::kind});
    using Messages = typename MessagesOf<typename KeyOf<Value>::Type>::Type;
    if constexpr (!std::is_void_v<Messages>) {
      fields.push_back({message_key(field.name), "the same by name, for other languages", SchemaOf<Messages>::of(all),
                        KeyKind::may_lack});
    }
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, kResult<Type>.fields);
  all[place].fields = std::move(fields);
}

// "rmse_um"; "rmse_UNIT" if the unit is only known at run time.
std::string key_text(const FieldSchema& field);

// "export interface Misfit { ... }", one after the other.
std::string typescript_of(const std::vector<ResultSchema>& schemas);

// A Python class for the return value of a function, with the keys of the results that it may be.
struct PythonClass {
  std::string name, function;
  std::vector<std::string> results;  // names of schemas, the usual one first
  std::string base = "Result";       // whose keys it has too
};

// "class Checked(Result): ...", one after the other. Throws Error where a result has no schema.
std::string python_of(const std::vector<PythonClass>& of, const std::vector<ResultSchema>& schemas);

// A table of the keys of one.
std::string markdown_of(const ResultSchema& schema);

}  // namespace ballbar
