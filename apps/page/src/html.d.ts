declare module "*.html" {
  const text: string;
  export default text;
}

// A catalogue of sentences, as catalogues.mjs reads it.
declare module "*.toml" {
  const catalogue: Readonly<Record<string, string>>;
  export default catalogue;
}
