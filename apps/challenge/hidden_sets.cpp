#include <fmt/format.h>

#include <random>

#include "challenge/blind_results.hpp"
#include "challenge/challenge.hpp"
#include "challenge/challenge_files.hpp"
#include "terminal/caller.hpp"
#include "terminal/progress.hpp"

namespace ballbar::commands {

namespace fs = std::filesystem;

void show_sets(std::string_view what, std::size_t done, std::size_t of) {
  show_progress(done == of ? "" : fmt::format("{} {} of {}", what, done, of));
}

fs::path answers_file(const fs::path& folder, const std::string& answers) {
  return answers.empty() ? folder / "answers.json" : fs::path(answers);
}

void make_hidden_sets(const HiddenSetsOptions& options) {
  std::uint64_t seed = 0;
  if (options.seed) {
    seed = static_cast<std::uint64_t>(*options.seed);
  } else {
    std::random_device random;
    seed = (std::uint64_t{random()} << 31) ^ random();
  }
  const auto count = static_cast<std::size_t>(options.count);
  const fs::path answers = answers_file(options.out, options.answers);
  const std::string digest =
      write_blind(options.out, answers, count, seed, [&](std::size_t done) { show_sets("making set", done, count); });
  if (options.json) {
    print_json(json_of(MadeSets{options.out, count, answers.string(), digest}));
    return;
  }
  fmt::print("written  {}: {} data set{}; README.txt explains their use\n", options.out, count, count == 1 ? "" : "s");
  fmt::print("answers  {}\n", answers.string());
  fmt::print("sealed   SHA-256 {} in {}\n", digest, (fs::path(options.out) / "SEAL").string());
}

}  // namespace ballbar::commands
