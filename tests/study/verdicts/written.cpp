#include "written.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/series/series_csv.hpp"

namespace ballbar::verdicts {
namespace {

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file) throw std::runtime_error("expected to write " + path.string() + ", could not");
}

nlohmann::ordered_json truth_of(const Made& made) {
  nlohmann::ordered_json truth;
  truth["what"] = made.what;
  truth["seed"] = made.seed;
  truth["d"] = made.d;
  truth["sigma_um"] = made.sigma_um;
  truth["outside"] = made.is_outside;
  truth["effects"] = nlohmann::ordered_json::array();
  for (const Truth& one : made.truths) {
    nlohmann::ordered_json effect{{"effect", one.effect}, {"columns", one.columns}};
    for (const ParameterTruth& parameter : one.parameters) effect["parameters"][parameter.name] = parameter.value;
    truth["effects"].push_back(effect);
  }
  if (made.own) {
    truth["own"] = {{"effect", made.own->effect},
                    {"parameter", made.own->parameter},
                    {"held", made.own->held},
                    {"value", made.own->value}};
  }
  truth["drivers"] = made.drivers;
  truth["without"] = made.without;
  return truth;
}

}  // namespace

void write(const Made& made, const std::string& folder) {
  const std::filesystem::path path(folder);
  std::filesystem::create_directories(path);
  write_file(path / "data.csv", write_series(made.data));
  write_file(path / "model.toml", write_model(made.model));
  write_file(path / "truth.json", truth_of(made).dump(2) + "\n");
}

}  // namespace ballbar::verdicts
