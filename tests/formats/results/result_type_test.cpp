#include "ballbar/formats/results/result_type.hpp"

#include <gtest/gtest.h>

#include <limits>

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
struct ResultType<Inner> {
  static constexpr std::string_view name = "Inner";
  static constexpr std::string_view meaning = "A length.";
  static constexpr std::tuple fields{Field{"length_mm", &Inner::length_mm, "of it"}};
};
template <>
struct ResultType<Outer> {
  static constexpr std::string_view name = "Outer";
  static constexpr std::string_view meaning = "All kinds of values.";
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&Outer::inner, ResultType<Inner>::fields),
                     std::tuple{
                         Field{"rows", &Outer::rows, ""}, Field{"known", &Outer::known, ""},
                         Field{"colour", &Outer::colour, ""}, Field{"n", &Outer::n, "as many"},
                         Field{"twice", [](const Outer& of) { return 2.0 * static_cast<double>(of.n); }, ""},
                         Field{"note", &Outer::note, ""},
                         Field{
                             "table",
                             [](const Outer& of) {
                               return TableOf<std::string>{{"b", "2"}, {"a", std::to_string(of.n)}};
                             },
                             ""},
                         Field{"again", &Outer::again, ""}});
};

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

}  // namespace
}  // namespace ballbar
