/** What swagger-ui-bundle.js brings: https://swagger.io/docs/open-source-tools/swagger-ui/usage/configuration/ */
declare function SwaggerUIBundle(options: Readonly<Record<string, unknown>>): unknown;
