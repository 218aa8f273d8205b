"""What people call the signals, in seven languages; several names each."""

LANGUAGES = ("en", "de", "fr", "it", "es", "zh", "ja")

NAMES = {
    "speed": {"en": ("Spindle speed", "Speed", "S actual"), "de": ("Spindeldrehzahl", "Drehzahl", "Drehzahl Spindel"),
              "fr": ("Vitesse broche", "Vitesse de rotation"), "it": ("Velocità mandrino", "Giri mandrino"),
              "es": ("Velocidad del husillo", "Velocidad husillo"), "zh": ("主轴转速", "转速"), "ja": ("主軸回転数", "回転速度")},
    "load": {"en": ("Spindle load", "Load"), "de": ("Spindellast", "Auslastung Spindel", "Spindelauslastung"),
             "fr": ("Charge broche", "Charge"), "it": ("Carico mandrino", "Carico"), "es": ("Carga del husillo", "Carga"),
             "zh": ("主轴负载", "负载"), "ja": ("主軸負荷", "負荷")},
    "power": {"en": ("Spindle power", "Power"), "de": ("Spindelleistung", "Leistung"), "fr": ("Puissance broche", "Puissance"),
              "it": ("Potenza mandrino", "Potenza"), "es": ("Potencia del husillo", "Potencia"), "zh": ("主轴功率", "功率"),
              "ja": ("主軸電力", "電力")},
    "torque": {"en": ("Torque", "Motor torque"), "de": ("Drehmoment", "Moment"), "fr": ("Couple",), "it": ("Coppia",),
               "es": ("Par",), "zh": ("扭矩",), "ja": ("トルク",)},
    "current": {"en": ("Motor current", "Current"), "de": ("Motorstrom", "Strom"), "fr": ("Courant moteur", "Courant"),
                "it": ("Corrente motore", "Corrente"), "es": ("Corriente", "Corriente motor"), "zh": ("电机电流", "电流"),
                "ja": ("モータ電流", "電流")},
    "feed": {"en": ("Feed", "Feed rate"), "de": ("Vorschub",), "fr": ("Avance",), "it": ("Avanzamento",), "es": ("Avance",),
             "zh": ("进给速度",), "ja": ("送り速度",)},
    "pressure": {"en": ("Pressure", "Air pressure"), "de": ("Druck", "Sperrluftdruck"), "fr": ("Pression",),
                 "it": ("Pressione",), "es": ("Presión",), "zh": ("压力",), "ja": ("圧力",)},
    "flow": {"en": ("Flow", "Coolant flow"), "de": ("Durchfluss",), "fr": ("Débit",), "it": ("Portata",), "es": ("Caudal",),
             "zh": ("流量",), "ja": ("流量",)},
    "voltage": {"en": ("Voltage", "AI0"), "de": ("Spannung",), "fr": ("Tension",), "it": ("Tensione",), "es": ("Tensión",),
                "zh": ("电压",), "ja": ("電圧",)},
    "T_room": {"en": ("Room temperature", "Room", "Ambient"), "de": ("Raumtemperatur", "Umgebung", "Halle", "Raum"),
               "fr": ("Température ambiante", "Ambiante"), "it": ("Temperatura ambiente", "Ambiente"),
               "es": ("Temperatura ambiente", "Ambiente"), "zh": ("室温", "环境温度"), "ja": ("室温", "周囲温度")},
    "T_coolant": {"en": ("Coolant temperature", "Coolant"), "de": ("Kühlmitteltemperatur", "Kühlmittel", "KSS"),
                  "fr": ("Liquide de refroidissement", "Température réfrigérant"), "it": ("Refrigerante", "Temp. refrigerante"),
                  "es": ("Refrigerante", "Temperatura refrigerante"), "zh": ("冷却液温度", "冷却液"), "ja": ("冷却水温度", "クーラント温度")},
    "T_bearing_front": {"en": ("Front bearing", "Bearing front"), "de": ("Lager vorne", "Lagertemperatur vorn", "Vorderes Lager"),
                        "fr": ("Palier avant", "Roulement avant"), "it": ("Cuscinetto anteriore",),
                        "es": ("Rodamiento delantero", "Cojinete delantero"), "zh": ("前轴承温度", "前轴承"), "ja": ("前側軸受温度", "前軸受")},
    "T_bearing_rear": {"en": ("Rear bearing", "Bearing rear"), "de": ("Lager hinten", "Hinteres Lager"),
                       "fr": ("Palier arrière", "Roulement arrière"), "it": ("Cuscinetto posteriore",),
                       "es": ("Rodamiento trasero", "Cojinete trasero"), "zh": ("后轴承温度", "后轴承"), "ja": ("後側軸受温度", "後軸受")},
    "T_motor": {"en": ("Motor temperature", "Winding"), "de": ("Motortemperatur", "Wicklung"), "fr": ("Température moteur",),
                "it": ("Temperatura motore",), "es": ("Temperatura motor",), "zh": ("电机温度",), "ja": ("モータ温度",)},
    "T_housing": {"en": ("Spindle housing",), "de": ("Spindelgehäuse",), "fr": ("Carter de broche",), "it": ("Corpo mandrino",),
                  "es": ("Carcasa del husillo",), "zh": ("主轴箱体温度",), "ja": ("主軸ハウジング温度",)},
    "T_column": {"en": ("Column", "Column temperature"), "de": ("Ständer", "Säule", "Ständertemperatur"),
                 "fr": ("Colonne", "Montant"), "it": ("Colonna", "Montante"), "es": ("Columna",), "zh": ("立柱温度", "立柱"),
                 "ja": ("コラム温度", "コラム")},
    "T_bed": {"en": ("Machine bed", "Bed"), "de": ("Maschinenbett", "Bett"), "fr": ("Bâti",), "it": ("Basamento", "Bancale"),
              "es": ("Bancada",), "zh": ("床身温度", "床身"), "ja": ("ベッド温度", "ベッド")},
    "T_head": {"en": ("Headstock",), "de": ("Spindelkasten", "Spindelstock"), "fr": ("Poupée",), "it": ("Testa",),
               "es": ("Cabezal",), "zh": ("主轴箱温度",), "ja": ("主軸頭温度",)},
    "T_oil": {"en": ("Oil temperature",), "de": ("Öltemperatur",), "fr": ("Température huile",), "it": ("Temperatura olio",),
              "es": ("Temperatura aceite",), "zh": ("油温",), "ja": ("油温",)},
    "T_nut": {"en": ("Ball screw nut",), "de": ("Spindelmutter Y",), "fr": ("Écrou vis à billes",), "it": ("Chiocciola",),
              "es": ("Tuerca",), "zh": ("丝杠螺母温度",), "ja": ("ボールねじナット温度",)},
    "pos_X": {"en": ("X position",), "de": ("Istposition X",), "fr": ("Position X",), "it": ("Posizione X",),
              "es": ("Posición X",), "zh": ("X轴位置",), "ja": ("X軸位置",)},
}
for axis in ("Y", "Z"):
    NAMES["pos_" + axis] = {language: (texts[0].replace("X", axis),) for language, texts in NAMES["pos_X"].items()}

PROBE_WORDS = {"en": ("Probe {}", "{} probe", "Displacement {}"), "de": ("Taster {}", "Messtaster {}", "Wegsensor {}"),
               "fr": ("Palpeur {}", "Capteur {}"), "it": ("Tastatore {}", "Sensore {}"), "es": ("Palpador {}", "Sensor {}"),
               "zh": ("位移传感器 {}", "测头 {}"), "ja": ("変位 {}", "変位計 {}")}

ROLES = {"speed": "speed", "load": "load", "power": "load", "T_room": "ambient", "T_coolant": "coolant",
         "T_bearing_front": "bearing", "T_bearing_rear": "bearing", "T_column": "structure", "T_bed": "structure",
         "T_head": "structure", "X1": "measured", "X2": "measured", "Y1": "measured", "Y2": "measured", "Z": "measured"}


def name_of(rng, key, language):
    """One of the names of the signal `key` in a language."""
    if key in NAMES:
        return rng.choice(NAMES[key][language])
    return rng.choice(PROBE_WORDS[language]).format(key)
