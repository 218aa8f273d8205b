#include "ballbar/formats/models/runs_csv.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "ballbar/error.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = R"(# chamber_degC: set point
# TC08_degC follows the chamber
run,chamber_degC,speed_plan
20200615,25,2000rpm
20200617,20to30,"1000, then ""2000"" rpm"
by hand.csv,,
)";

TEST(runs, names_files_and_texts) {
  const RunList list = read_runs(kList, "runs.csv");
  EXPECT_EQ(list.columns, (std::vector<std::string>{"chamber_degC", "speed_plan"}));
  ASSERT_EQ(list.runs.size(), 3u);
  EXPECT_EQ(list.runs[0].name, "20200615");
  EXPECT_EQ(list.runs[0].file, "20200615.csv");
  EXPECT_EQ(list.runs[0].about, (std::vector<std::string>{"25", "2000rpm"}));
  EXPECT_EQ(list.runs[0].line, 4u);
  EXPECT_EQ(list.runs[1].about, (std::vector<std::string>{"20to30", "1000, then \"2000\" rpm"}));
  EXPECT_EQ(list.runs[2].name, "by hand.csv");
  EXPECT_EQ(list.runs[2].file, "by hand.csv");
  EXPECT_EQ(list.runs[2].about, (std::vector<std::string>{"", ""}));
  EXPECT_EQ(list.runs[2].line, 6u);
}

TEST(runs, files_are_paths_relative_to_the_list) {
  const RunList list = read_runs("file\na.csv\nsummer/a.csv\n./winter/../b\n", "runs.csv");
  EXPECT_TRUE(list.columns.empty());
  ASSERT_EQ(list.runs.size(), 3u);
  EXPECT_EQ(list.runs[1].name, "summer/a.csv");
  EXPECT_EQ(list.runs[1].file, "summer/a.csv");
  EXPECT_EQ(list.runs[2].file, "./winter/../b");
}

TEST(runs, windows_line_ends_mark_blanks_and_quotes) {
  const RunList list = read_runs(
      "\xEF\xBB\xBF# a\r\nrun , \"note, if any\"\r\n\t1 , \"#x\" \r\n\"2\",\xC3\xA9 \r\n3,a b\r\n\r\n", "runs.csv");
  EXPECT_EQ(list.columns, std::vector<std::string>{"note, if any"});
  ASSERT_EQ(list.runs.size(), 3u);
  EXPECT_EQ(list.runs[0].name, "1");
  EXPECT_EQ(list.runs[0].about, std::vector<std::string>{"#x"});
  EXPECT_EQ(list.runs[1].file, "2.csv");
  EXPECT_EQ(list.runs[1].about, std::vector<std::string>{"\xC3\xA9"});
  EXPECT_EQ(list.runs[2].about, std::vector<std::string>{"a b"});
}

std::string quoted(const std::string& cell) {
  std::string result = "\"";
  for (const char c : cell) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + "\"";
}

TEST(runs, any_printable_text_in_quotes_is_kept) {
  const bool passed = rc::check([] {
    const auto about = *rc::gen::container<std::vector<std::string>>(
        3, rc::gen::container<std::string>(rc::gen::elementOf(std::string("\", ,a#;\t'\\"))));
    const RunList list =
        read_runs("run,a,b,c\nx," + quoted(about[0]) + "," + quoted(about[1]) + " , " + quoted(about[2]), "runs.csv");
    RC_ASSERT(list.runs.at(0).about == about);
  });
  EXPECT_TRUE(passed);
}

std::string rows(std::size_t count) {
  std::string text = "run\n";
  for (std::size_t i = 0; i < count; ++i) text += std::to_string(i) + "\n";
  return text;
}

TEST(runs, hundred_thousand) { EXPECT_EQ(read_runs(rows(100000), "runs.csv").runs.size(), 100000u); }

struct Bad {
  std::string text;
  std::string message;
};

TEST(runs, bad_text) {
  using namespace std::string_literals;
  std::string columns = "run";
  for (int i = 1; i <= 100; ++i) columns += ",c" + std::to_string(i);
  const Bad cases[] = {
      {"", "runs.csv:1:1: expected text, found an empty file."},
      {"run\n1\0"s, "runs.csv:2:2: expected text, found a NUL byte; this is a binary file."},
      {"\xFF\xFEr\0u\0n\0"s, "runs.csv:1:1: expected UTF-8, found UTF-16. Save the file as UTF-8."},
      {"run\n\xE9\n", "runs.csv:2:1: expected UTF-8, found the byte \"\\xE9\". Save the file as UTF-8."},
      {"# nothing else\n", "runs.csv:2:1: expected a header such as run,speed_rpm, found the end of the file."},
      {"\r\n\n", "runs.csv:3:1: expected a header such as run,speed_rpm, found the end of the file."},
      {"# a\n\nrun\n1\n", "runs.csv:2:1: expected a header whose first column is run or file, found \"\"."},
      {"20200615,25\n20200617,25\n",
       "runs.csv:1:1: expected a header whose first column is run or file, found \"20200615\"."},
      {" Run,a\n1,2\n", "runs.csv:1:2: expected a header whose first column is run or file, found \"Run\"."},
      {"run;a\n1;2\n",
       "runs.csv:1:1: expected a header whose first column is run or file, found \"run;a\"; columns are separated by "
       "commas."},
      {"run,\n1,2\n", "runs.csv:1:5: expected the name of a column, found nothing."},
      {"run,a, a\n1,2,3\n", "runs.csv:1:8: expected each column once, found \"a\" again."},
      {"run,run\n1,2\n", "runs.csv:1:5: expected each column once, found \"run\" again."},
      {columns + "\n", "runs.csv:1:1: expected at most 100 columns, found more."},
      {"run\n", "runs.csv:2:1: expected at least one run, found the end of the file."},
      {"file,a", "runs.csv:1:7: expected at least one file, found the end of the file."},
      {"run,a\n1\n",
       "runs.csv:2:1: expected 2 cells, one for each column, found 1; a comma in a cell needs quotes around it."},
      {"run,a\n1,2\n3,4,5\n",
       "runs.csv:3:1: expected 2 cells, one for each column, found 3; a comma in a cell needs quotes around it."},
      {"run\n" + std::string(200, ',') + "\n",
       "runs.csv:2:1: expected 1 cell, one for each column, found more; a comma in a cell needs quotes around it."},
      {"run,a\n1,2\n \t\n3,4\n", "runs.csv:3:1: expected a row of 2 cells, found an empty line."},
      {"run,a\n1,2\n#\"3,4\n", "runs.csv:3:1: expected comments above the header alone, found one below it."},
      {"run,a\n,2\n", "runs.csv:2:1: expected a name for run, found nothing."},
      {"file,a\n \"\",2\n", "runs.csv:2:2: expected a name for file, found nothing."},
      {"run,a\n1,2\n3,4\n1,5\n", "runs.csv:4:1: expected each run once, found \"1\" again."},
      {"run\n1\n./1.csv\n", "runs.csv:3:1: expected each run once, found \"./1.csv\" again."},
      {"file\na/b\na/../a/b\n", "runs.csv:3:1: expected each file once, found \"a/../a/b\" again."},
      {"run\n../1\n", "runs.csv:2:1: expected a run inside the list's folder, found \"../1\"."},
      {"run,a\n1,2\n a/../../1.csv,2\n",
       "runs.csv:3:2: expected a run inside the list's folder, found \"a/../../1.csv\"."},
      {"file\n/etc/passwd\n", "runs.csv:2:1: expected a file inside the list's folder, found \"/etc/passwd\"."},
      {"file\n..\n", "runs.csv:2:1: expected a file inside the list's folder, found \"..\"."},
      {"file\na/..\n", "runs.csv:2:1: expected a file inside the list's folder, found \"a/..\"."},
      {"file\n" + std::string(4097, 'a'), "runs.csv:2:1: expected at most 4096 bytes for file, found 4097."},
      {"run,a\n1,\xC3\xA9\"b\"\n",
       "runs.csv:2:3: expected quotes around a whole cell, each quote in it doubled, found \"\xC3\xA9\"b\"\"."},
      {"run,a\n1,\"b\"c\n", "runs.csv:2:6: expected a comma after a cell in quotes, found \"c\"."},
      {"run,a,b\n1,2,\"3\n4\"\n", "runs.csv:2:5: expected a quote that ends this cell on its line, found \"\"3\"."},
      {"run,a\n1,\x1B[2J\n", "runs.csv:2:3: expected printable text, found \"\\x1B[2J\"."},
      {"run\n1\r2\n", "runs.csv:2:1: expected printable text, found \"1\\x0D2\"."},
      {rows(100001), "runs.csv:100002:1: expected at most 100000 runs, found more."},
  };
  for (const Bad& bad : cases) {
    try {
      read_runs(bad.text, "runs.csv");
      ADD_FAILURE() << "accepted: " << bad.text.substr(0, 100);
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), bad.message);
    }
  }
}

TEST(runs, opened_beside_the_list) {
  const ScratchFolder folder;
  const fs::path path = folder.write("runs.csv", "file,a\n1.csv,x\nsub/2.csv,y\n");
  const RunList list = open_runs(path);
  EXPECT_EQ(list.runs[0].file, folder.path() / "1.csv");
  EXPECT_EQ(list.runs[1].file, folder.path() / "sub/2.csv");
  EXPECT_EQ(list.runs[1].name, "sub/2.csv");
}

TEST(runs, a_link_out_of_the_folder_is_refused) {
  const ScratchFolder outside;
  const fs::path elsewhere = outside.write("2.csv", "time_s,x_um\n0,0\n");
  const ScratchFolder folder;
  const fs::path path = folder.write("runs.csv", "run\n1\n2\n");
  folder.write("1.csv", "time_s,x_um\n0,0\n");
  fs::create_symlink(elsewhere, folder.path() / "2.csv");
  EXPECT_EQ(complaint(folder, [&] { open_runs(path); }),
            "DIR/2.csv: expected a file inside the list's folder, found a link or path that leaves it.");
  fs::remove(folder.path() / "2.csv");
  fs::create_symlink("1.csv", folder.path() / "2.csv");
  EXPECT_NO_THROW(open_runs(path));
}

TEST(runs, a_list_that_cannot_be_opened) {
  const ScratchFolder folder;
  EXPECT_EQ(complaint(folder, [&] { open_runs(folder.path() / "runs.csv"); }),
            "DIR/runs.csv: expected a file, found nothing of that name.");
}

}  // namespace
}  // namespace ballbar
