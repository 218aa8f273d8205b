"""Workbooks as bytes, by hand: shared and inline strings, styles, formulas with cached values, merged cells, 1904 dates."""

import io
import zipfile
from dataclasses import dataclass, field
from xml.sax.saxutils import escape, quoteattr

# Number formats by the index of the style
FORMATS = {"general": 0, "stamp": 1, "stamp_ms": 2, "elapsed": 3, "date": 4, "clock": 5, "two": 6, "bold": 7, "german_stamp": 8,
           "minutes": 9}
CODES = (0, 22, 164, 46, 14, 21, 2, 0, 165, 166)
CUSTOM = {164: "yyyy\\-mm\\-dd\\ hh:mm:ss.000", 165: "dd/mm/yyyy\\ hh:mm:ss", 166: "mm:ss.0"}

MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"


@dataclass
class Sheet:
    name: str
    rows: list                    # rows of cells; a cell is None, a text, a Number, a Formula or an Error
    first_row: int = 1
    merged: tuple = ()
    state: str = ""               # "hidden"
    references: bool = True       # whether rows and cells say where they are


@dataclass
class Number:
    text: str
    style: str = "general"


@dataclass
class Formula:
    formula: str
    value: str                    # the cached value
    style: str = "general"


@dataclass
class Error:
    text: str


@dataclass
class Inline:
    text: str


@dataclass
class Strings:
    order: dict = field(default_factory=dict)
    count: int = 0

    def index(self, text):
        self.count += 1
        return self.order.setdefault(text, len(self.order))


def letters(column):
    text = ""
    while column >= 0:
        text, column = chr(65 + column % 26) + text, column // 26 - 1
    return text


def cell_xml(cell, where, strings):
    r = f' r="{where}"' if where else ""
    if isinstance(cell, Number):
        return f'<c{r} s="{FORMATS[cell.style]}"><v>{cell.text}</v></c>'
    if isinstance(cell, Formula):
        return f'<c{r} s="{FORMATS[cell.style]}"><f>{escape(cell.formula)}</f><v>{cell.value}</v></c>'
    if isinstance(cell, Error):
        return f'<c{r} t="e"><v>{cell.text}</v></c>'
    if isinstance(cell, Inline):
        return f'<c{r} t="inlineStr"><is><t xml:space="preserve">{escape(cell.text)}</t></is></c>'
    return f'<c{r} t="s"><v>{strings.index(cell)}</v></c>'


def sheet_xml(sheet, strings):
    out = []
    for i, row in enumerate(sheet.rows):
        number = sheet.first_row + i
        body = "".join(cell_xml(cell, f"{letters(j)}{number}" if sheet.references else "", strings)
                       for j, cell in enumerate(row) if cell is not None or not sheet.references)
        if row:
            out.append((f'<row r="{number}">' if sheet.references else "<row>") + body + "</row>")
    merged = "".join(f'<mergeCell ref="{m}"/>' for m in sheet.merged)
    merged = f'<mergeCells count="{len(sheet.merged)}">{merged}</mergeCells>' if merged else ""
    return f'<worksheet xmlns="{MAIN}"><sheetData>{"".join(out)}</sheetData>{merged}</worksheet>'


def styles_xml():
    custom = "".join(f'<numFmt numFmtId="{i}" formatCode={quoteattr(code)}/>' for i, code in CUSTOM.items())
    fonts = '<fonts count="1"><font><sz val="11"/><name val="Calibri"/></font></fonts>'
    fills = '<fills count="1"><fill><patternFill patternType="none"/></fill></fills>'
    borders = '<borders count="1"><border/></borders>'
    base = '<cellStyleXfs count="1"><xf numFmtId="0"/></cellStyleXfs>'
    xfs = "".join(f'<xf numFmtId="{i}" fontId="0" fillId="0" borderId="0" xfId="0" applyNumberFormat="1"/>' for i in CODES)
    return (f'<styleSheet xmlns="{MAIN}"><numFmts count="{len(CUSTOM)}">{custom}</numFmts>{fonts}{fills}{borders}{base}'
            f'<cellXfs count="{len(CODES)}">{xfs}</cellXfs></styleSheet>')


def workbook(sheets, date1904=False, rich=()):
    """The bytes of the file. Texts in `rich` are stored in runs, as where a part of a cell is bold."""
    strings = Strings()
    parts = {f"xl/worksheets/sheet{i + 1}.xml": sheet_xml(s, strings) for i, s in enumerate(sheets)}
    listed = "".join(f'<sheet name={quoteattr(s.name)} sheetId="{i + 1}"' + (f' state="{s.state}"' if s.state else "") +
                     f' r:id="rId{i + 1}"/>' for i, s in enumerate(sheets))
    kinds = [("worksheet", f"worksheets/sheet{i + 1}.xml") for i in range(len(sheets))]
    kinds += [("styles", "styles.xml"), ("sharedStrings", "sharedStrings.xml")]
    relations = "".join(f'<Relationship Id="rId{i + 1}" Type="{OFFICE}/{kind}" Target="{path}"/>' for i, (kind, path) in enumerate(kinds))
    items = ""
    for text in strings.order:
        if text in rich:
            half = len(text) // 2
            items += f'<si><r><t xml:space="preserve">{escape(text[:half])}</t></r><r><rPr><b/></rPr><t>{escape(text[half:])}</t></r></si>'
        else:
            items += f'<si><t xml:space="preserve">{escape(text)}</t></si>'
    parts["xl/sharedStrings.xml"] = f'<sst xmlns="{MAIN}" count="{strings.count}" uniqueCount="{len(strings.order)}">{items}</sst>'
    parts["xl/styles.xml"] = styles_xml()
    parts["xl/workbook.xml"] = (f'<workbook xmlns="{MAIN}" xmlns:r="{OFFICE}"><workbookPr' + (' date1904="1"' if date1904 else "") +
                                f'/><sheets>{listed}</sheets></workbook>')
    parts["xl/_rels/workbook.xml.rels"] = f'<Relationships xmlns="{PACKAGE}/relationships">{relations}</Relationships>'
    parts["_rels/.rels"] = (f'<Relationships xmlns="{PACKAGE}/relationships"><Relationship Id="rId1" Type="{OFFICE}/officeDocument" '
                            'Target="xl/workbook.xml"/></Relationships>')
    sheet_type = "application/vnd.openxmlformats-officedocument.spreadsheetml."
    overrides = "".join(f'<Override PartName="/{path}" ContentType="{sheet_type}{kind}+xml"/>' for path, kind in
                        [("xl/workbook.xml", "sheet.main"), ("xl/styles.xml", "styles"), ("xl/sharedStrings.xml", "sharedStrings")] +
                        [(f"xl/worksheets/sheet{i + 1}.xml", "worksheet") for i in range(len(sheets))])
    parts["[Content_Types].xml"] = (f'<Types xmlns="{PACKAGE}/content-types"><Default Extension="rels" ContentType='
                                    f'"application/vnd.openxmlformats-package.relationships+xml"/>{overrides}</Types>')
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in ["[Content_Types].xml"] + [p for p in parts if p != "[Content_Types].xml"]:
            info = zipfile.ZipInfo(path, (2026, 1, 1, 0, 0, 0))
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n' + parts[path])
    return out.getvalue()
