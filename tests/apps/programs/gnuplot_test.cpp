#include "programs/gnuplot.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>
#include <optional>

#include "scratch_folder.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

// A variable of the environment for one test, put back after it.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_{name} {
    if (const char* const now = std::getenv(name)) before_ = now;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

constexpr const char* kStart = "set encoding utf8\nset terminal svg noenhanced\nset xrange [0:1]\n";

std::string svg_titled(const std::string& title) {
  return svg_by_gnuplot(kStart + ("set title " + gnuplot_quoted(title)) + "\nplot 0 notitle\n");
}

// What drawing says where `program` stands for gnuplot.
std::string complaint_with(const std::string& program) {
  const ScratchFolder folder;
  fs::permissions(folder.write("gnuplot", "#!/bin/sh\n" + program + "\n"), fs::perms::owner_all);
  const Variable path("PATH", folder.path().string());
  return complaint(folder, [] { svg_by_gnuplot("plot 0\n"); });
}

TEST(gnuplot_quoted, leaves_no_sign_that_gnuplot_reads) {
  EXPECT_EQ(gnuplot_quoted("tilt 1, (a + b) / 2"), R"("tilt 1, (a + b) / 2")");
  EXPECT_EQ(gnuplot_quoted(R"('"`\$@{;#)"), R"("\047\042\140\134\044\100\173\073\043")");
  EXPECT_EQ(gnuplot_quoted("µ 温度"), "\"µ 温度\"");
}

TEST(gnuplot_quoted, replaces_what_an_svg_cannot_hold) {
  EXPECT_EQ(gnuplot_quoted("a\nb\r\tc\x1b\x7f"), "\"a b  c  \"");
  EXPECT_EQ(gnuplot_quoted(std::string("a\0b", 3)), "\"a b\"");
  EXPECT_EQ(gnuplot_quoted("a\u0085\u2028b"), "\"a  b\"");
  EXPECT_EQ(gnuplot_quoted("\xff"
                           "a"),
            "\"\uFFFDa\"");                                             // no UTF-8
  EXPECT_EQ(gnuplot_quoted("\xe6\xb8"), "\"\uFFFD\uFFFD\"");            // cut off
  EXPECT_EQ(gnuplot_quoted("\xc0\xa7"), "\"\uFFFD\uFFFD\"");            // ' in two bytes
  EXPECT_EQ(gnuplot_quoted("\xed\xa0\x80"), "\"\uFFFD\uFFFD\uFFFD\"");  // a surrogate
  EXPECT_EQ(gnuplot_quoted("\uFFFF"), "\"\uFFFD\uFFFD\uFFFD\"");        // not in XML
  EXPECT_EQ(gnuplot_quoted("]]>"), R"("\135\135 \076")");
}

// As gnuplot writes a text: only < and & are escaped.
TEST(gnuplot_quoted, comes_out_as_text) {
  const char* const pairs[][2] = {
      {R"(' ` " \n \101 {/Bold x} @a $b %d ^2 _2)", R"(' ` " \n \101 {/Bold x} @a $b %d ^2 _2)"},
      {"'''", "'''"},
      {"<script> & &lt;", "&lt;script> &amp; &amp;lt;"},
      {"µ 温度", "µ 温度"},
      {"]]>", "]] >"},
  };
  for (const auto& [title, text] : pairs) {
    EXPECT_NE(svg_titled(title).find(">" + std::string(text) + "</text>"), std::string::npos) << title;
  }
}

TEST(gnuplot_quoted, is_not_run) {
  const ScratchFolder folder;
  const std::string file = (folder.path() / "made").string();
  for (const std::string before : {"", "'", "''", "\"", "\\", "\n", "' `", "\" `", "';", "\"\n"}) {
    svg_titled(before + "`touch " + file + "`");
    svg_titled(before + "$(touch " + file + ")");
    svg_titled(before + " . system('touch " + file + "') . " + before);
    svg_titled(before + "; system 'touch " + file + "' #");
    svg_titled(before + "!touch " + file);
  }
  EXPECT_FALSE(fs::exists(file));
  // Seen to be made where it is not quoted.
  svg_by_gnuplot(std::string(kStart) + "set title \"`touch " + file + "`\"\nplot 0\n");
  EXPECT_TRUE(fs::exists(file));
}

TEST(gnuplot, draws_the_same_bytes_again) { EXPECT_EQ(svg_titled("x"), svg_titled("x")); }

TEST(gnuplot, does_not_heed_the_settings_of_the_user) {
  const ScratchFolder folder;
  folder.write(".gnuplot", "set title 'mine'\n");
  const std::string svg = svg_titled("x");
  const Variable home("HOME", folder.path().string());
  const Variable locale("LC_ALL", "C");
  const Variable terminal("GNUTERM", "nonsense");
  EXPECT_EQ(svg_titled("x"), svg);
}

// More than a pipe holds (64 KiB) both ways.
TEST(gnuplot, long_scripts_and_pictures_do_not_block) {
  std::string script = std::string(kStart) + "$a << EOD\n";
  for (int i = 0; i < 20000; ++i) script += "0." + std::to_string(10000 + i) + " 0." + std::to_string(i % 7) + "\n";
  const std::string svg = svg_by_gnuplot(script + "EOD\nplot $a with points notitle\n");
  EXPECT_GT(script.size(), std::size_t{200000});
  EXPECT_GT(svg.size(), std::size_t{200000});
}

TEST(gnuplot, missing_is_said_with_the_package) {
  const ScratchFolder folder;
  const Variable path("PATH", folder.path().string());
  EXPECT_EQ(complaint(folder, [] { svg_by_gnuplot("plot 0\n"); }),
            "--plot: expected the program gnuplot to draw with, found none; on Debian it is in the package "
            "gnuplot-nox.");
}

TEST(gnuplot, failures_are_whole_sentences) {
  // The reason is gnuplot's own: "unrecognized option" in 5.4.
  const ScratchFolder folder;
  const std::string said = complaint(folder, [] { svg_by_gnuplot("set nonsense\n"); });
  EXPECT_TRUE(said.starts_with("--plot: expected gnuplot to draw, found it ended with status 1: line ")) << said;
  EXPECT_EQ(complaint_with("echo first >&2; echo '  last. ' >&2; exit 3"),
            "--plot: expected gnuplot to draw, found it ended with status 3: last.");
  EXPECT_EQ(complaint_with("exit 3"), "--plot: expected gnuplot to draw, found it ended with status 3.");
  EXPECT_EQ(complaint_with("kill -9 $$"), "--plot: expected gnuplot to draw, found it ended by signal 9.");
  EXPECT_EQ(complaint_with("echo '<svg>'"),
            "--plot: expected a whole SVG from gnuplot, found an output without its end.");
}

// A gnuplot that ends before it reads its script is no SIGPIPE here, and the caller's choice stays.
TEST(gnuplot, signals_stay_as_they_are) {
  struct sigaction before {};
  struct sigaction after {};
  sigaction(SIGPIPE, nullptr, &before);
  EXPECT_EQ(complaint_with("exit 0"), "--plot: expected a whole SVG from gnuplot, found an output without its end.");
  sigaction(SIGPIPE, nullptr, &after);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
}

}  // namespace
}  // namespace ballbar
