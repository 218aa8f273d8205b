// What types of results hold, for whoever reads their JSON in another language.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

enum class ValueKind {
  number,  // or null, where it is not known
  whole,   // a whole number
  truth,   // true or false
  text,
  list,    // of `of`
  table,   // of `of` by a text
  result,  // of the type `name`
};

struct ValueSchema {
  ValueKind kind = ValueKind::number;
  bool or_null = false;
  std::string name = {};
  std::vector<ValueSchema> of = {};  // one, or none
};

struct FieldSchema {
  std::string name, meaning;
  ValueSchema value;
  bool may_lack = false;
};

struct ResultSchema {
  std::string name, meaning;
  std::vector<FieldSchema> fields;
};

// Adds the type, and behind it those that its fields mention, each once.
template <Described Type>
void add_schema(std::vector<ResultSchema>& all);

// The type of a value, with the types that it mentions.
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
      return {ValueKind::result, false, std::string(ResultType<Value>::name)};
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

template <class Value>
struct LackOf {
  using Type = Value;
  static constexpr bool may = false;
};
template <class Value>
struct LackOf<MayLack<Value>> {
  using Type = Value;
  static constexpr bool may = true;
};

template <Described Type>
void add_schema(std::vector<ResultSchema>& all) {
  const auto is_it = [](const ResultSchema& one) { return one.name == ResultType<Type>::name; };
  if (std::any_of(all.begin(), all.end(), is_it)) return;
  const std::size_t place = all.size();  // at once: a field may be of the type itself
  all.push_back({std::string(ResultType<Type>::name), std::string(ResultType<Type>::meaning), {}});
  std::vector<FieldSchema> fields;
  const auto add = [&](const auto& field) {
    using Value = std::remove_cvref_t<std::invoke_result_t<decltype(field.get), const Type&>>;
    fields.push_back({std::string(field.name), std::string(field.meaning),
                      SchemaOf<typename LackOf<Value>::Type>::of(all), LackOf<Value>::may});
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, ResultType<Type>::fields);
  all[place].fields = std::move(fields);
}

// "export interface Misfit { ... }", one after the other.
std::string typescript_of(const std::vector<ResultSchema>& schemas);
// A table of the keys of one.
std::string markdown_of(const ResultSchema& schema);

}  // namespace ballbar
