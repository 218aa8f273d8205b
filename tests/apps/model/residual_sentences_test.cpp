// What a fit says of its residual.
#include "model/residual_sentences.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ballbar/message_catalogue.hpp"

namespace ballbar {
namespace {

constexpr Whiteness kWhite{{}, 0.05, 0.42};

Fit fit_with(std::size_t rows, double rmse_um, const Noise& noise = {1.0, 0.0, 0.0, 0.0}) {
  Fit fit;
  fit.noise = noise;
  fit.rmse_um = rmse_um;
  for (std::size_t i = 0; i < rows; ++i) {
    fit.row.push_back(i);
    fit.time_s.push_back(60.0 * static_cast<double>(i));
    fit.residual_um.push_back(i % 2 == 0 ? rmse_um : -rmse_um);
  }
  return fit;
}

TEST(ResidualSentences, of_a_model_that_fails) {
  Fit fit = fit_with(400, 0.801);
  fit.floor = {0.1, messages::noise_of_standstill("510", "569")};
  const Misfit worst{"regime", "after a change of speed", "after a change of speed", 28, -3.0, 0.126, 3.0, 0.99};
  EXPECT_EQ(texts_of(sentences(fit, {worst}, Whiteness{{}, 0.5, 1e-9})),
            (std::vector<std::string>{
                "Remaining error 0.801 um RMS, 8.0 times the noise. The noise is 0.1 um (standstill from 510 to 569 "
                "min).",
                "The model fails most after a change of speed: 99 % of the squared error in 7 % of the readings, bias "
                "-3.00 ± 0.13 um.",
                "The residual is not noise (p < 0.000001)."}));
}

TEST(ResidualSentences, of_a_model_that_is_adequate) {
  Fit fit = fit_with(400, 1.0);
  fit.floor = {0.98, messages::noise_of_repeats(3U)};
  EXPECT_EQ(texts_of(sentences(fit, {}, kWhite)),
            (std::vector<std::string>{
                "Remaining error 1 um RMS, about the noise. The noise is 0.98 um (3 pairs of repeats).",
                "The error is spread evenly over the data.", "The residual looks like noise (p = 0.42)."}));
}

TEST(ResidualSentences, of_slow_noise_and_of_few_readings) {
  EXPECT_EQ(text_of(sentences(fit_with(400, 1.0, {0.5, 1.0, 2100.0, 0.0}), {}, kWhite)[2]),
            "The residual changes slowly (about 35 min): slow noise or a missing effect (p = 0.42).");
  EXPECT_EQ(texts_of(sentences(fit_with(4, 1.0), {}, {})),
            (std::vector<std::string>{"Remaining error 1 um RMS. The noise is not known.",
                                      "The error is spread evenly over the data.",
                                      "4 readings are too few to tell whether the residual is random."}));
}

TEST(ResidualSentences, name_the_place) {
  const auto place = [](const std::string& what, const std::string& from, const std::string& to) {
    return text_of(misfit_place({what, from, to}));
  };
  EXPECT_EQ(place("time", "0 min", "60 min"), "from 0 to 60 min");
  EXPECT_EQ(place("T_air_degC", "20 degC", "22.5 degC"), "where T_air_degC is from 20 to 22.5 degC");
  EXPECT_EQ(place("speed_rpm", "0 rpm", "0 rpm"), "where speed_rpm is at 0 rpm");
  EXPECT_EQ(place("regime", "warming", "warming"), "while warming");
  EXPECT_EQ(place("regime", "cooling", "cooling"), "while cooling");
  EXPECT_EQ(place("regime", "steady", "steady"), "at steady speed");
  EXPECT_EQ(place("regime", "standstill", "standstill"), "at standstill");
}

}  // namespace
}  // namespace ballbar
