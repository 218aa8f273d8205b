declare module "*.html" {
  const text: string;
  export default text;
}

// A catalogue of formats/messages, as text.
declare module "*.toml" {
  const text: string;
  export default text;
}
