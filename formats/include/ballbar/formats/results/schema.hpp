// The schema of the types of results, for readers of their JSON in other languages.
#pragma once

#include <string>
#include <vector>

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

// False: it is there already. Throws Error if another type has its name.
bool add_name(std::vector<ResultSchema>& all, ResultSchema schema);
// In the place of the field of its key, if there is one.
void add_field(std::vector<FieldSchema>& fields, FieldSchema field);

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
