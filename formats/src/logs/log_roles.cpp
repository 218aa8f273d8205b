#include "logs/log_roles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "ballbar/internal/nearest_name.hpp"
#include "logs/text_fold.hpp"

namespace ballbar {
namespace {

constexpr double kTravel_um = 5000.0;  // what moves further is an axis, no probe
constexpr double kFarFromZero_um = 20000.0;

// Folded. Of five letters and more anywhere in a name, since German joins words; shorter ones as words alone.
constexpr std::string_view kSpeed =
    "speed|drehzahl|rpm|vitesse|rotation|regime|velocita|giri|velocidad|umdrehung|转速|回転数|速度|n ist|n soll|"
    "s actual|nist|nsoll|spindle s|revs|борот|корость";
constexpr std::string_view kLoad =
    "load|last|auslastung|spindellast|belastung|charge|carico|carga|power|leistung|puissance|potenza|potencia|"
    "torque|moment|couple|coppia|par|current|strom|courant|corrente|corriente|负载|负荷|負荷|功率|电流|電流|扭矩|"
    "トルク|電力|ロード|utilization|lmdat";
constexpr std::string_view kAmbient =
    "ambient|amb|raumluft|umg|room|umgebung|raum|raumtemperatur|hall|halle|ambiant|ambiante|salle|ambiente|sala|"
    "stanza|air|luft|aria|aire|atelier|officina|taller|环境|室温|室内|車間|车间|雰囲気|外気|気温|空气|environment|"
    "оздух|"
    "umgebungstemperatur|shop|werkstatt|周围|周囲";
constexpr std::string_view kCoolant =
    "coolant|cooling|kuhlmittel|kuhlwasser|kss|refrigerant|refroidissement|fluide|liquide|lubrorefrigerante|"
    "refrigerante|chiller|kuhlung|kuhler|vorlauf|rucklauf|oil|oel|ol|olio|aceite|huile|冷却|冷却液|冷卻|クーラント|"
    "冷却水|冷却油|油温|切削液|kuehlmittel|raffreddamento|kuhlschmierstoff|taladrina|emulsion|lubrificante|冷媒";
constexpr std::string_view kBearing =
    "bearing|lager|одшипник|palier|roulement|cuscinetto|cuscinetti|rodamiento|cojinete|轴承|ベアリング|軸受|"
    "vorderlager|"
    "hinterlager|festlager|loslager";
constexpr std::string_view kHousing =
    "housing|gehause|spindelgehause|carter|carcasa|alloggiamento|carcassa|壳体|主轴箱|ハウジング|spindelkasten|"
    "gehaeuse|boitier|机壳|主軸台";
constexpr std::string_view kMeasured =
    "probe|taster|мещени|sensor x|verlagerung|verschiebung|weg|drift|deplacement|palpeur|spostamento|sonda|tastatore|"
    "desplazamiento|error|abweichung|位移|変位|palpador|capteur|测头|プローブ|误差|gap|abstand|tir|gauge|delta l|"
    "deviation|ecart|wegsensor|elongation|längung|laengung|err|fehler|disp|displ|dilatation|dehnung|growth|dl|"
    "verformung|lvdt|length|deformation|伸长|变形|伸び|偏差|erreur|desviacion";
constexpr std::string_view kTemperature =
    "temp|temperatur|емператур|tmp|thermo|termocoppia|termopar|pt|pt100|tc|rtd|ntc|thermistor|温|热电偶";
// Parts that the roles above do not name.
constexpr std::string_view kSpindle = "spindle|spindel|mandrino|husillo|broche|主轴|主軸|スピンドル";
constexpr std::string_view kStructure =
    "bed|bett|maschinenbett|bancada|banc|bancale|basamento|lit|床身|ベッド|column|stander|saule|colonne|montante|"
    "colonna|columna|立柱|コラム|frame|rahmen|gestell|bati|telaio|bastidor|机架|フレーム|motor|moteur|motore|电机|"
    "電機|モータ|马达|table|tisch|tavola|mesa|工作台|テーブル|headstock|kopf|testa|cabezal|nut|mutter|screw|"
    "ballscrew|spindelmutter|kugelgewindetrieb|丝杠|螺母|ボールねじ|guide|guideway|fuhrung|导轨|光栅|extruder|"
    "nozzle|hotend|heater|sockel|底座|横梁|crossbeam|traverse|portal|gantry|turret|revolver|chuck|futter|pinole|"
    "滑枕|flange|flansch";
constexpr std::string_view kChamber = "chamber|enclosure|kammer|klimakammer|klimaschrank|恒温";
constexpr std::string_view kOtherPercent =
    "humidity|feuchte|humidite|umidita|humedad|湿度|override|ventil|valve|fullstand|level|duty|rh|pegel|battery|"
    "vorschub";
constexpr std::string_view kSetPoint =
    "soll|sollwert|set|setpoint|target|nominal|cmd|command|consigne|consigna|setp|sp|设定|設定";
// Of what is no temperature, whatever part it is of.
constexpr std::string_view kOtherQuantity =
    "id|no|nr|number|index|quality|flow|durchfluss|debit|portata|caudal|流量|pressure|druck|pression|presion|压力|"
    "圧力|voltage|spannung|tension|电压|電圧|volt|pos|position|posizione|posicion|位置|axis|achse|feed|vib|rms|"
    "freq|frequency|state|status|alarm|code|count|zahler|adc|raw|bit|day|month|hour|minute|tag|week|power|target|"
    "setpoint|set|soll|sollwert|pwm|fan|bat|tool|program|cycle|step|gain|angle|winkel";

bool says(const std::string& key, std::string_view words) {
  const std::string spaced = " " + key + " ";
  return any_word(words, [&](std::string_view word) {
    const bool other_script = static_cast<unsigned char>(word.front()) >= 0x80;
    if (word.size() >= 5 || other_script) return key.find(word) != std::string::npos;
    // A short word alone, or with a number behind it: temp1.
    for (std::size_t at = spaced.find(word); at != std::string::npos; at = spaced.find(word, at + 1)) {
      const char before = spaced[at - 1], after = spaced[at + word.size()];
      if (before == ' ' && (after == ' ' || (after >= '0' && after <= '9'))) return true;
    }
    return false;
  });
}

// Whether a word of the name is one of these, or so near that it is one misspelled: a letter, of eight and more two. It
// begins alike.
bool nearly_says(const std::string& key, std::string_view words) {
  if (says(key, words)) return true;
  for (std::size_t at = 0; at < key.size();) {
    const std::size_t end = std::min(key.find(' ', at), key.size());
    const std::string_view written = std::string_view(key).substr(at, end - at);
    at = end + 1;
    if (written.size() < 5) continue;
    const bool near = any_word(words, [&](std::string_view word) {
      const std::size_t most = word.size() >= 8 ? 2 : 1;
      return word.size() >= 5 && word.front() == written.front() && letters_apart(written, word) <= most;
    });
    if (near) return true;
  }
  return false;
}

// "t3", "t 3", "t", "frame t", "t air"; a letter alone is the name of a temperature too.
bool has_letter_t(const std::string& key) {
  const std::string spaced = " " + key + " ";
  for (std::size_t at = spaced.find(" t"); at != std::string::npos; at = spaced.find(" t", at + 1)) {
    std::size_t end = at + 2;
    while (end < spaced.size() && is_digit(spaced[end])) ++end;
    if (spaced[end] == ' ') return true;
  }
  return false;
}

// Held for many rows at round numbers of at least 200, never below 0: a spindle's programme.
bool moves_as_speed(std::span<const double> values) {
  const Extremes range = extremes_of(values);
  if (!(range.least >= 0.0 && range.most >= 200.0 && range.most <= 100000.0 && range.most - range.least >= 200.0))
    return false;
  std::size_t held = 0, round = 0, rows = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    ++rows;
    if (values[i] != values[i - 1]) continue;
    ++held;
    round += std::fmod(values[i], 10.0) == 0.0;
  }
  return rows >= 20 && held * 10 >= rows * 7 && round * 10 >= held * 9;
}

// "x1", "z", "dx", "delta z", "y2": probes on the axes of a machine.
bool names_a_probe(const std::string& key) {
  std::string_view name = key;
  if (name.starts_with("delta "))
    name.remove_prefix(6);
  else if (name.starts_with('d'))
    name.remove_prefix(1);
  return !name.empty() && name.size() <= 2 && name[0] >= 'x' && name[0] <= 'z' &&
         (name.size() == 1 || (name[1] >= '1' && name[1] <= '3'));
}

constexpr std::size_t kFewLevels = 6, kRowsOfALevel = 4;
constexpr double kWholeDegree = 1.0;

// The role of a temperature by the part of the machine that the name says.
std::optional<Role> role_of_part(const std::string& key) {
  constexpr std::pair<std::string_view, Role> kParts[] = {
      {kBearing, Role::bearing}, {kCoolant, Role::coolant},     {kHousing, Role::housing}, {kAmbient, Role::ambient},
      {kChamber, Role::ambient}, {kStructure, Role::structure}, {kSpindle, Role::housing}};
  for (const auto& [words, role] : kParts) {
    if (nearly_says(key, words)) return role;
  }
  return std::nullopt;
}

FoundRole temperature_role(const std::string& key) {
  if (says(key, kSetPoint)) return {Role::event, "a set point", ""};
  const auto role = role_of_part(key);
  return {role.value_or(Role::structure), role ? "by its name" : "by its unit", ""};
}

}  // namespace

Extremes extremes_of(std::span<const double> values, double but) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Extremes found{kInfinite, -kInfinite};
  for (const double value : values) {
    if (!std::isfinite(value) || value == but) continue;
    found.least = std::min(found.least, value);
    found.most = std::max(found.most, value);
  }
  return found;
}

bool is_switch(std::span<const double> values) {
  const auto is = [&](double level) { return std::find(values.begin(), values.end(), level) != values.end(); };
  return is(0.0) && is(1.0) &&
         std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v) || v == 0.0 || v == 1.0; });
}

bool has_few_levels(std::span<const double> values) {
  std::set<double> levels;
  std::size_t rows = 0;
  double largest_step = 0.0, last = NAN;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    ++rows;
    levels.insert(value);
    if (levels.size() > kFewLevels) return false;
    if (std::isfinite(last)) largest_step = std::max(largest_step, std::abs(value - last));
    last = value;
  }
  if (std::all_of(levels.begin(), levels.end(), [](double level) { return level == 0.0 || level == 1.0; })) return true;
  return levels.size() > 1 && rows >= kRowsOfALevel * levels.size() && largest_step > kWholeDegree;
}

bool names_the_room(std::string_view name) { return nearly_says(parted(name), kAmbient); }

bool names_a_speed(std::string_view name) {
  const std::string key = parted(name);
  return says(key, kSpeed) && !says(key, kLoad);
}

bool could_be_measured(std::string_view name) {
  constexpr std::string_view kWords = "x|y|z|pos|position|steps|counts|count|probe";
  const std::string key = parted(name);
  return says(key, kWords) && !says(key, kSetPoint);
}

bool says_temperature(std::string_view name) {
  const std::string key = parted(name);
  return says(key, kTemperature) || has_letter_t(key);
}

bool names_a_part(std::string_view name) { return role_of_part(parted(name)).has_value(); }

bool names_an_axis(std::string_view name) {
  const std::string key = parted(name);
  return key.size() == 1 && key[0] >= 'x' && key[0] <= 'z';
}

bool names_another_quantity(std::string_view name) {
  const std::string key = parted(name);
  return says(key, kOtherPercent) || says(key, kOtherQuantity) || says(key, kSpeed) || says(key, kLoad) ||
         says(key, kMeasured) || names_a_probe(key);
}

FoundRole found_role(std::string_view name, std::string_view unit, std::span<const double> values) {
  const std::string key = parted(name);
  if (unit == "degC" || unit == "K") return temperature_role(key);
  if (unit == "rpm") return {Role::speed, "by its unit", ""};
  if (unit == "A" || unit == "W" || unit == "Nm") return {Role::load, "by its unit", ""};
  if (unit == "percent") {
    if (says(key, kLoad) && !says(key, kOtherPercent)) return {Role::load, "by its name", ""};
    return {Role::event, "", ""};
  }
  if (unit == "urad") return {Role::measured, "by its unit", ""};
  if (unit == "um" || unit == "mm") {
    const Extremes range = extremes_of(values);
    const double one = unit == "mm" ? 1e3 : 1.0;
    const double travel_um = (range.most - range.least) * one;
    const double far_um = std::max(std::abs(range.most), std::abs(range.least)) * one;
    if (travel_um > kTravel_um) {
      return {Role::event, fmt::format("moves by {:.0f} mm, so it is an axis, not a probe", travel_um * 1e-3), ""};
    }
    if (far_um > kFarFromZero_um && !says(key, kMeasured)) return {Role::event, std::string(kFarFromZero), ""};
    return {Role::measured, "by its unit", ""};
  }
  if (unit == "V" && says(key, kMeasured)) return {Role::measured, "by its name", ""};
  if (!unit.empty()) return {Role::event, "", ""};
  // Without a unit.
  if (is_switch(values)) return {Role::event, "0 and 1, on and off", ""};
  const Extremes range = extremes_of(values);
  const bool part = says(key, kCoolant) || says(key, kBearing) || says(key, kAmbient);  // "Lager" is in "Verlagerung"
  if (says(key, kTemperature) || (part && !says(key, kLoad) && !says(key, kSpeed) && !says(key, kMeasured))) {
    if (has_few_levels(values)) return {Role::event, "held at few levels, so no temperature", ""};
    if (range.least > -40.0 && range.least < kWarmestRoom_degC && range.most < 150.0) {
      FoundRole found = temperature_role(key);
      return {found.role, "by its name; no unit, read as degC by its values", "degC"};
    }
    return {Role::event, "a temperature by its name, in which unit?", ""};
  }
  if (names_a_speed(name)) {
    if (range.least >= -100000.0 && range.most >= 100.0)
      return {Role::speed, "by its name; no unit, read as rpm", "rpm"};
    return {Role::speed, "by its name", ""};
  }
  if (says(key, kLoad)) return {Role::load, "by its name", ""};
  constexpr std::string_view kStates = "code|count|counter|state|status|id|no|nr|number|index|alarm|flag|times|anzahl";
  if ((says(key, kMeasured) || names_a_probe(key)) && !says(key, kStates)) {
    if (range.most - range.least > kTravel_um) return {Role::event, "moves too far for a probe", ""};
    return {Role::measured, "by its name, in which unit?", ""};
  }
  if (moves_as_speed(values) && !says(key, kOtherQuantity))
    return {Role::speed, "constant at round numbers, like a speed; no unit, read as rpm", "rpm"};
  return {Role::event, "", ""};
}

}  // namespace ballbar
