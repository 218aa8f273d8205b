#include "model/formula.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"

namespace ballbar {
namespace {

struct Function {
  std::string_view name;
  std::size_t fewest = 1;  // arguments
  std::size_t most = 1;
};
constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

constexpr std::array kFunctions = {
    Function{"lag", 2, 2},    Function{"sin"},          Function{"cos"},         Function{"tan"},
    Function{"asin"},         Function{"acos"},         Function{"atan"},        Function{"sinh"},
    Function{"cosh"},         Function{"tanh"},         Function{"asinh"},       Function{"acosh"},
    Function{"atanh"},        Function{"atan2", 2, 2},  Function{"exp"},         Function{"ln"},
    Function{"log"},          Function{"log2"},         Function{"log10"},       Function{"sqrt"},
    Function{"abs"},          Function{"sign"},         Function{"rint"},        Function{"min", 1, kAny},
    Function{"max", 1, kAny}, Function{"sum", 1, kAny}, Function{"avg", 1, kAny}};
constexpr std::array<std::string_view, 2> kConstants = {"_pi", "_e"};
constexpr std::array<std::string_view, 6> kLongOperators = {"&&", "||", "<=", ">=", "==", "!="};

const Function* find_function(std::string_view name) {
  const auto* const function =
      std::find_if(kFunctions.begin(), kFunctions.end(), [&](const Function& f) { return f.name == name; });
  return function == kFunctions.end() ? nullptr : function;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// What an open bracket waits for; the outermost is the formula itself.
struct Open {
  const Function* function = nullptr;  // nullptr: a plain bracket
  std::size_t column = 0;
  std::size_t arguments = 0;     // finished by a comma
  std::size_t conditionals = 0;  // `?` that wait for their `:`
  std::string first;             // a lag's first argument
  std::string text;
};

class Reader {
 public:
  explicit Reader(std::string_view formula) : formula_(formula) {}

  Formula read() {
    if (formula_.size() > kLongestFormula) {
      throw Error(fmt::format("formula: expected at most {} bytes, found {}.", kLongestFormula, formula_.size()));
    }
    open_.emplace_back();
    while (skip_blanks(), at_ < formula_.size()) token();
    if (expects_value_) fail(at_, "expected a value, found the end.");
    expect_no_conditional(at_, "the end");
    if (open_.size() > 1) {
      fail(at_, fmt::format("expected \")\" for the \"(\" at column {}, found the end.", open_.back().column));
    }
    out_.text = std::move(open_.back().text);
    return std::move(out_);
  }

 private:
  std::size_t column_of(std::size_t offset) const {
    const std::string_view before = formula_.substr(0, offset);
    return 1 + static_cast<std::size_t>(std::count_if(before.begin(), before.end(), [](char c) {
             return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
           }));
  }

  [[noreturn]] void fail(std::size_t offset, std::string_view sentence) const {
    throw Error(fmt::format("formula, column {}: {}", column_of(offset), sentence));
  }

  void skip_blanks() {
    while (at_ < formula_.size() && is_blank(formula_[at_])) ++at_;
  }

  template <class Predicate>
  std::string_view take_while(Predicate predicate) {
    const std::size_t from = at_;
    while (at_ < formula_.size() && predicate(formula_[at_])) ++at_;
    return formula_.substr(from, at_ - from);
  }

  void token() {
    const char c = formula_[at_];
    if (is_digit(c) || c == '.') return number();
    if (is_letter(c)) return name();
    if (c == '(') {
      expect_operand("(");
      return open(nullptr);
    }
    if (c == ')') return close();
    if (c == ',') return comma();
    sign_or_operator();
  }

  void expect_operand(std::string_view found) const {
    if (!expects_value_) fail(at_, fmt::format("expected an operator, found {}.", in_quotes(found)));
  }

  void value(std::string_view text) {
    open_.back().text += text;
    expects_value_ = signed_ = false;
  }

  void number() {
    const std::size_t from = at_;
    const std::string_view rest = formula_.substr(at_);
    double number = 0.0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if (error == std::errc::invalid_argument) fail(from, "expected a digit beside the point, found none.");
    const std::string_view digits = rest.substr(0, static_cast<std::size_t>(end - rest.data()));
    expect_operand(digits);
    if (error == std::errc::result_out_of_range) {
      fail(from, fmt::format("expected a number that a double can hold, found {}.", in_quotes(digits)));
    }
    at_ += digits.size();
    value(fmt::format("{}", number));
  }

  void name() {
    const std::size_t from = at_;
    const std::string_view found = take_while([](char c) { return is_letter(c) || is_digit(c); });
    const std::size_t after = at_;
    at_ = from;
    expect_operand(found);
    at_ = after;
    skip_blanks();
    const bool call = at_ < formula_.size() && formula_[at_] == '(';
    const Function* function = find_function(found);
    if (call && function == nullptr) {
      std::vector<std::string_view> known;
      known.reserve(std::size(kFunctions));
      for (const Function& candidate : kFunctions) known.push_back(candidate.name);
      fail(from, fmt::format("expected one of the functions {}, found {}; the nearest known name is {}.",
                             fmt::join(known, ", "), in_quotes(found), nearest_name(found, known)));
    }
    if (call) return open(function);
    if (function != nullptr) {
      fail(after, fmt::format("expected \"(\" after the function {}, found {}.", found, next_in_quotes()));
    }
    const bool own =
        found == kFormulaTime || std::find(kConstants.begin(), kConstants.end(), found) != kConstants.end();
    value(own ? std::string(found) : variable(found, from));
  }

  std::string next_in_quotes() const {
    if (at_ == formula_.size()) return "the end";
    return in_quotes(formula_.substr(at_, std::max<std::size_t>(1, utf8_length(formula_.substr(at_, 4)))));
  }

  std::string variable(std::string_view found, std::size_t offset) {
    auto known = std::find_if(out_.names.begin(), out_.names.end(), [&](const auto& n) { return n.name == found; });
    if (known == out_.names.end()) {
      known = out_.names.insert(known, {std::string(found), column_of(offset)});
    }
    return fmt::format("{}{}", kFormulaName, known - out_.names.begin());
  }

  void open(const Function* function) {
    if (open_.size() > kDeepestBrackets) {
      fail(at_, fmt::format("expected at most {} brackets in one another, found more.", kDeepestBrackets));
    }
    open_.push_back({function, column_of(at_)});
    ++at_;
    expects_value_ = true;
    signed_ = false;
  }

  void close() {
    if (open_.size() == 1) fail(at_, "expected \"(\" before its \")\", found none.");
    const Open& last = open_.back();
    const bool empty = expects_value_ && last.arguments == 0 && last.text.empty();
    if (expects_value_ && !(empty && last.function != nullptr)) fail(at_, "expected a value, found \")\".");
    expect_no_conditional(at_, "\")\"");
    Open done = std::move(open_.back());
    open_.pop_back();
    if (done.function != nullptr) expect_arguments(*done.function, empty ? 0 : done.arguments + 1);
    ++at_;
    if (done.function == nullptr) return value("(" + done.text + ")");
    if (done.function->name != kFormulaLag) return value(fmt::format("{}({})", done.function->name, done.text));
    if (out_.lags.size() == kMostLags) {
      fail(at_ - 1, fmt::format("expected at most {} lags in one formula, found more.", kMostLags));
    }
    value(fmt::format("{}{}", kFormulaLag, out_.lags.size()));
    out_.lags.push_back({std::move(done.first), std::move(done.text)});
  }

  void expect_arguments(const Function& function, std::size_t found) const {
    if (found >= function.fewest && found <= function.most) return;
    fail(at_, fmt::format("expected {}{} argument{} of {}, found {}.", function.most == kAny ? "at least " : "",
                          function.fewest, function.fewest == 1 ? "" : "s", function.name,
                          found == 0 ? "none" : std::to_string(found)));
  }

  void comma() {
    if (open_.back().function == nullptr) {
      fail(at_, "expected \",\" only between the arguments of a function, found one elsewhere; decimals need a point.");
    }
    if (expects_value_) fail(at_, "expected a value, found \",\".");
    expect_no_conditional(at_, "\",\"");
    Open& call = open_.back();
    ++call.arguments;
    if (call.function->name == kFormulaLag) {
      if (call.arguments > 1) expect_arguments(*call.function, call.arguments + 1);
      call.first = std::move(call.text);
      call.text.clear();
    } else {
      call.text += ',';
    }
    ++at_;
    expects_value_ = true;
  }

  void expect_no_conditional(std::size_t offset, std::string_view found) const {
    if (open_.back().conditionals > 0) fail(offset, fmt::format("expected \":\" after \"?\", found {}.", found));
  }

  void sign_or_operator() {
    const char c = formula_[at_];
    if (expects_value_ && (c == '-' || c == '+') && !signed_) {
      open_.back().text += c;
      signed_ = true;
      ++at_;
      return;
    }
    const std::string_view two = formula_.substr(at_, 2);
    const bool is_long = std::find(kLongOperators.begin(), kLongOperators.end(), two) != kLongOperators.end();
    const std::string_view found = is_long ? two : two.substr(0, 1);
    if (!is_long && found == "=") fail(at_, "expected \"==\" to compare, found \"=\"; a formula assigns nothing.");
    if (!is_long && std::string_view("+-*/^<>?:").find(c) == std::string_view::npos) {
      fail(at_, fmt::format("expected a name, a number, an operator or a bracket, found {}.", in_quotes(found)));
    }
    if (expects_value_) fail(at_, fmt::format("expected a value, found {}.", in_quotes(found)));
    std::size_t& conditionals = open_.back().conditionals;
    if (found == "?") ++conditionals;
    if (found == ":" && conditionals-- == 0) fail(at_, "expected \"?\" before \":\", found none.");
    open_.back().text += found;
    at_ += found.size();
    expects_value_ = true;
  }

  std::string_view formula_;
  std::size_t at_ = 0;
  bool expects_value_ = true;
  bool signed_ = false;  // a sign stands before the value to come
  std::vector<Open> open_;
  Formula out_;
};

}  // namespace

Formula parse_formula(std::string_view formula) {
  if (std::all_of(formula.begin(), formula.end(), is_blank)) throw Error("formula: expected a formula, found nothing.");
  return Reader(formula).read();
}

}  // namespace ballbar
