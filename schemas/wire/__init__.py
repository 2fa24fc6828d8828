"""How messages are made: base classes of models and structs, validation errors, descriptions, JSON Schemas, units."""
