// Signatures against a residual.
#include "diagnosis/signatures/signature_library.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../made_recordings.hpp"
#include "diagnosis/by_hand.hpp"
#include "noise/whitening.hpp"
#include "series/subsampled.hpp"

namespace ballbar {
namespace {

// The model is a constant: (1, -1, 1, -1) / 2 survives whole, (1, 1, 1, 1) not at all; r = 3 (1, -1, 1, -1).
TEST(SignatureLibrary, score_is_the_fall_of_chi2) {
  Eigen::MatrixXd columns(4, 2);
  columns << 2, 1, -2, 1, 2, 1, -2, 1;
  const SignatureLibrary library = by_hand::library_with(columns);
  const Eigen::VectorXd residual = (Eigen::VectorXd(4) << 3, -3, 3, -3).finished();
  const std::vector<double> time_s{0.0, 60.0, 120.0, 180.0};
  const Noise noise{2.0, 0.0, 0.0, 0.0};
  const SignatureProjection seen =
      signature_projection(library, Eigen::MatrixXd::Ones(4, 1), Whitening(noise, time_s, {}));
  const Eigen::VectorXd found = (seen.columns.transpose() * residual / noise.white_um).cwiseAbs2();  // one column each
  EXPECT_NEAR(found[0], 36.0 / 4.0, 1e-12);
  EXPECT_NEAR(found[1], 0.0, 1e-12);
  EXPECT_NEAR(seen.share[0], 1.0, 1e-12);
  EXPECT_NEAR(seen.share[1], 0.0, 1e-12);
  EXPECT_NEAR(seen.norm[0], 4.0 / 2.0, 1e-12);
}

// 360 readings in a sweep of 18.8 s, or every third: 19.1 or 6.4 a second. Above half of that a vibration passes for a
// slow one, and for the form of the path.
TEST(SignatureLibraryOfRecordings, has_no_frequency_above_half_the_rate_of_the_rows) {
  const Series all = made::circles(made::both_ways(), 360);
  const Effect* vibration = find_effect("vibration", Level::recording);
  const auto highest_Hz = [&](std::size_t most) {
    const Series trace = subsampled(all, "deviation_um", most);
    const SignatureLibrary library = signature_library_of(built_in_catalogue(), recording_base_model(trace), trace,
                                                          fit(recording_base_model(trace), trace));
    double highest = 0.0;
    for (const Signature& signature : library.signatures) {
      if (library.families[signature.family].bound.effect == vibration) highest = std::max(highest, signature.point[4]);
    }
    return highest;
  };
  EXPECT_NEAR(highest_Hz(720), 9.5, 0.1);
  EXPECT_NEAR(highest_Hz(240), 3.2, 0.1);
}

}  // namespace
}  // namespace ballbar
