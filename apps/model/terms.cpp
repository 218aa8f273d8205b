#include "model/terms.hpp"

#include <fmt/format.h>

#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr ExplainedTerm kTerms[] = {
    {"2 ln B", "2 ln of how much more likely the readings are with an effect than without: 0 is even, 10 is 150 to 1."},
    {"P", "Probability of what is said, 0 to 1; 0.98 is 49 to 1."},
    {"p", "Share of pure noise that would show as much as was seen, or more; small: it is not noise."},
    {"RMSE", "Size of what a model leaves, in um: root of the mean square of measured less modelled."},
    {"autocorrelation", "How alike readings are some steps apart, -1 to 1; 0: nothing is remembered."},
    {"bias", "Mean of what a model leaves: how far it is off to one side."},
    {"chi^2", "Squares of what is left, each in units of its own scatter, summed up; its fall weighs an effect."},
    {"coherence", "How much two signals go together at each pace of change, 0 to 1."},
    {"correlation", "How far two values go together, -1 to 1; near either end the data cannot tell them apart."},
    {"discrepancy", "What is left that changes slowly and has no cause that the model knows."},
    {"evidence", "What the readings say for one explanation against another, beyond a fall of the error."},
    {"floor", "What is left at best: scatter of readings that should be equal, which no model can explain."},
    {"forecast", "Prediction of readings that come after all those that a model was fitted to."},
    {"held out", "Left out of the fit and then predicted: what a model makes of readings that it has not seen."},
    {"independent", "Readings with a memory repeat each other: so many without one would tell as much."},
    {"innovation", "Reading less what the readings before it and the model predict for it."},
    {"ln B",
     "Half of 2 ln B; of a run that is followed, of anything that is missing against nothing: 8.5 is 5000 to 1."},
    {"misfit", "What a model leaves, squared and summed up: where most of it is, the model fails most."},
    {"odds", "P of one thing over P of another, or of all others: 49 to 1 is P of 0.98."},
    {"periodogram", "How much of what is left moves at each pace; of white noise, the same at all."},
    {"prior", "What is held to be so before the readings speak, where they alone would hardly tell."},
    {"rms", "Root of the mean square: the usual size of values that go to both sides of 0."},
    {"robust", "With single outlying values discounted, so that they do not pull the result."},
    {"sigma", "Scatter of a value, the number behind ±: 68 of 100 repeats lie within it, 95 within two of it."},
    {"significant", "Larger than noise makes it but in 1 of 100 tests."},
    {"standard deviation", "As rms, about the mean: 68 of 100 values lie within it."},
    {"surrogate", "A made signal as smooth as a real one and without a cause: what it explains is chance."},
    {"variance", "Square of the standard deviation: shares of it add up to 1."},
    {"white", "Noise without a memory: no reading tells of the next."},
    {"whitened", "Freed of the noise's memory, so that what is left should be white."},
};

}  // namespace

std::span<const ExplainedTerm> explained_terms() { return kTerms; }

void print_terms() {
  Table table({"term", "means"});
  for (const ExplainedTerm& term : explained_terms()) {
    table.add({std::string(term.name), std::string(term.meaning)});
  }
  fmt::print("{}", table.left_aligned(table_width()));
}

}  // namespace ballbar
