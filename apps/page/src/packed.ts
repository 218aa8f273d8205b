// What tool.mjs packed into a page.

const kEscape = 0x3d;
const kHigh = Uint8Array.from({ length: 32 }, (_, k) => 0x80 + k); // what windows-1252 has elsewhere

// The bytes that tool.mjs packed: a sign each.
const bytes_of_signs = (text: string): Uint8Array<ArrayBuffer> => {
  const high = new Map([...new TextDecoder("windows-1252").decode(kHigh)].map((sign, k) => [sign.charCodeAt(0), 0x80 + k]));
  const bytes = new Uint8Array(text.length);
  let count = 0;
  for (let k = 0; k < text.length; ++k) {
    const code = text.charCodeAt(k);
    if (code === kEscape) bytes[count++] = text.charCodeAt(++k) - 64;
    else bytes[count++] = code < 0x100 ? code : (high.get(code) ?? 0);
  }
  return bytes.subarray(0, count);
};

export const unpacked = async (text: string): Promise<ArrayBuffer> => {
  const stream = new Blob([bytes_of_signs(text)]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
};
