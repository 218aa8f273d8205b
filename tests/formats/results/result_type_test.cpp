#include "ballbar/formats/results/result_type.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <variant>

#include "ballbar/error.hpp"
#include "ballbar/formats/results/schema.hpp"

namespace ballbar {

enum class Colour { red };
static std::string_view name_of(Colour) { return "red"; }

struct Inner {
  double length_mm = std::numeric_limits<double>::quiet_NaN();
};
struct Outer {
  Inner inner;
  std::vector<Inner> rows{{1.5}, {}};
  std::optional<bool> known;
  Colour colour = Colour::red;
  std::size_t n = 3;
  MayLack<std::string> note;
  std::vector<Outer> again;
};

template <>
inline constexpr auto kResult<Inner> = ResultType("Inner", "A length.", Field{"length_mm", &Inner::length_mm, "of it"});
template <>
inline constexpr auto kResult<Outer> = ResultType(
    "Outer", "All kinds of values.", fields_of(&Outer::inner), Field{"rows", &Outer::rows},
    Field{"known", &Outer::known}, Field{"colour", &Outer::colour}, Field{"n", &Outer::n, "as many"},
    Field{"twice", [](const Outer& of) { return 2.0 * static_cast<double>(of.n); }}, Field{"note", &Outer::note},
    Field{"table",
          [](const Outer& of) {
            return TableOf<std::string>{{"b", "2"}, {"a", std::to_string(of.n)}};
          }},
    Field{"again", &Outer::again});

struct Keys {
  OfUnit<double> rmse;
  KeysOf<double> axes;
  Bulk column;
  double sure = 0.0;
  std::variant<Inner, Outer> one;
};
template <>
inline constexpr auto kResult<Keys> = ResultType("Keys", "Keys of all kinds.", Field{"rmse", &Keys::rmse},
                                                 Field{"AXIS", &Keys::axes}, Field{"column", &Keys::column},
                                                 Field{"sure", known(&Keys::sure)}, Field{"one", &Keys::one});

struct Reading {
  std::optional<Inner> inner, lacking;
  std::optional<double> sigma;
  std::string unit = "um";
  std::vector<double> values{1.0, 2.0};
  double mean() const { return 1.5; }
};
constexpr bool is_drawn(const Reading&) { return true; }
constexpr bool is_hidden(const Reading&) { return false; }
template <>
inline constexpr auto kResult<Reading> =
    ResultType("Reading", "Fields of parts.", Field{"length_mm", in(&Reading::inner, &Inner::length_mm)},
               Field{"other_mm", in(&Reading::lacking, &Inner::length_mm)}, Field{"unit", &Reading::values},
               Field{"gone", may_lack(in(&Reading::lacking, &Inner::length_mm))},
               Field{"sigma", with_unit(may_lack(&Reading::sigma))}, Field{"mean", with_unit(&Reading::mean)},
               Field{"readings", count(&Reading::values)}, Field{"drawn", where(&is_drawn, &Reading::sigma)},
               Field{"hidden", where(&is_hidden, &Reading::sigma)},
               FieldList{Field{"column", bulk(&Reading::values)}, Field{"name", may_lack(&Reading::unit)}},
               Field{"unit", &Reading::unit, "in the place of the first"});

struct OtherInner {};
template <>
inline constexpr auto kResult<OtherInner> = ResultType("Inner", "Another one.");

namespace {

TEST(ResultType, JsonHasTheFieldsInTheirOrder) {
  Outer outer;
  EXPECT_EQ(json_of(outer).dump(),
            R"({"length_mm":null,"rows":[{"length_mm":1.5},{"length_mm":null}],"known":null,"colour":"red","n":3,)"
            R"("twice":6.0,"table":{"b":"2","a":"3"},"again":[]})");
  outer.note.value = "here";
  outer.known = true;
  const nlohmann::ordered_json json = json_of(outer);
  EXPECT_EQ(json["note"], "here");
  EXPECT_EQ(json["known"], true);
}

TEST(ResultType, SchemaHasTheFieldsOfAllTypesItMentions) {
  std::vector<ResultSchema> all;
  add_schema<Outer>(all);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(typescript_of(all),
            "// All kinds of values.\nexport interface Outer {\n"
            "  length_mm: Num; // of it\n  rows: Inner[];\n  known: boolean | null;\n  colour: string;\n"
            "  n: number; // as many\n  twice: Num;\n  note?: string;\n  table: Record<string, string>;\n"
            "  again: Outer[];\n}\n\n// A length.\nexport interface Inner {\n  length_mm: Num; // of it\n}\n\n");
  EXPECT_EQ(markdown_of(all[1]), "| key | holds |\n|---|---|\n| `length_mm` | of it |\n");
}

// What is written of a result, in all languages.
struct Written {
  std::string json, typescript, python, markdown;
};

template <Described Type>
Written written(const Type& result) {
  std::vector<ResultSchema> all;
  add_schema<Type>(all);
  const std::string name(kResult<Type>.name);
  return {json_of(result).dump(), typescript_of(all), python_of({{name, "fit", {name}}}, all),
          markdown_of(all.front())};
}

TEST(ResultType, AFieldIsFoundInAllThatIsWritten) {
  const Written all = written(Outer{});
  EXPECT_NE(all.json.find("\"twice\":6.0"), std::string::npos);
  EXPECT_NE(all.typescript.find("  twice: Num;\n"), std::string::npos);
  EXPECT_NE(all.python.find("    twice: float\n"), std::string::npos);
  EXPECT_NE(all.markdown.find("| `twice` |"), std::string::npos);
}

TEST(ResultType, PythonHasTheKeysAsAttributesOfAClass) {
  EXPECT_EQ(
      written(Outer{}).python,
      "\n\nclass Outer(Result):\n    \"\"\"All kinds of values, :func:`ballbar.fit`.\n\n    Attributes\n"
      "    ----------\n    length_mm : float\n        Of it, mm.\n    rows : Rows[Inner]\n        A length.\n"
      "    known : bool | None\n        Known.\n    colour : str\n        Colour.\n    n : int\n        As many.\n"
      "    twice : float\n        Twice.\n    note : str\n        Note.\n    table : Result\n        Table.\n"
      "    again : Rows[Outer]\n        All kinds of values.\n    \"\"\"\n\n    length_mm: float\n"
      "    rows: Rows[Inner]\n    known: bool | None\n    colour: str\n    n: int\n    twice: float\n    note: str\n"
      "    table: Result\n    again: Rows[Outer]\n\n\nclass Inner(Result):\n    \"\"\"A length.\n\n    Attributes\n"
      "    ----------\n    length_mm : float\n        Of it, mm.\n    \"\"\"\n\n    length_mm: float\n");
}

TEST(ResultType, KeysAreWrittenAsTheyAreMade) {
  Keys keys{{2.0, "um"}, {{{"x_um", 1.0}, {"y_um", 2.0}}}, {{1.23456789, 1e-9 / 3.0}}, 4.0, Inner{1.0}};
  Written all = written(keys);
  EXPECT_EQ(
      all.json,
      R"({"rmse_um":2.0,"x_um":1.0,"y_um":2.0,"column":[1.234568,3.333333e-10],"sure":4.0,"one":{"length_mm":1.0}})");
  EXPECT_EQ(
      all.typescript.substr(0, all.typescript.find("// A length.")),
      "// Keys of all kinds.\nexport interface Keys {\n  [key: `rmse_${string}`]: Num;\n  [key: string]: unknown;\n"
      "  column: Num[];\n  sure: number;\n  one: Inner | Outer;\n}\n\n");
  EXPECT_NE(all.markdown.find("| `rmse_UNIT` |"), std::string::npos);
  EXPECT_NE(all.python.find("    rmse_UNIT : float\n"), std::string::npos);
  EXPECT_EQ(all.python.find("    rmse_UNIT: float\n"), std::string::npos);
  keys.rmse.unit = "";
  EXPECT_EQ(json_of(keys)["rmse"], 2.0);
}

TEST(ResultType, FieldsOfPartsAreNullOrLacking) {
  Reading reading{Inner{2.0}, std::nullopt, std::nullopt};
  const Written all = written(reading);
  EXPECT_EQ(all.json, R"({"length_mm":2.0,"other_mm":null,"unit":"um","mean_um":1.5,"readings":2,"drawn":null,)"
                      R"("column":[1.0,2.0],"name":"um"})");
  EXPECT_EQ(all.typescript,
            "// Fields of parts.\nexport interface Reading {\n  length_mm: Num;\n  other_mm: Num;\n"
            "  unit: string; // in the place of the first\n  gone?: Num;\n  [key: `sigma_${string}`]: Num;\n"
            "  [key: `mean_${string}`]: Num;\n  readings: number;\n  drawn?: Num;\n  hidden?: Num;\n"
            "  column: Num[];\n  name?: string;\n}\n\n");
  reading.sigma = 0.5;
  EXPECT_EQ(json_of(reading)["sigma_um"], 0.5);
}

TEST(ResultType, TwoTypesOfOneNameAreRefused) {
  std::vector<ResultSchema> all;
  add_schema<Inner>(all);
  add_schema<Inner>(all);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_THROW(add_schema<OtherInner>(all), Error);
}

}  // namespace
}  // namespace ballbar
