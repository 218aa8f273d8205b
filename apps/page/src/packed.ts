// What tool.mjs packed into a page: Base64, which no server and no mail program changes, of gzip, which a browser unpacks
// by itself; the module and the sample runs of xz (worker.ts), which makes them smaller by a third, as much as Base64 makes
// them larger.

export const bytes_of_base64 = (text: string): Uint8Array<ArrayBuffer> => {
  const signs = atob(text);
  const bytes = new Uint8Array(signs.length);
  for (let k = 0; k < signs.length; ++k) bytes[k] = signs.charCodeAt(k);
  return bytes;
};

export const gunzipped = async (text: string): Promise<ArrayBuffer> => {
  const stream = new Blob([bytes_of_base64(text)]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
};
