//! The schema beside the loader and the shipped scenarios.

use serde_json::{Value, json};

use super::*;
use crate::scenario::schema::schema;

/// Whether a value has the structure that a schema asks for: the keywords that ours uses, `root` being the whole.
fn conforms(value: &Value, schema: &Value, root: &Value) -> Result<(), String> {
    if let Some(place) = schema.get("$ref") {
        let pointer = place.as_str().unwrap().trim_start_matches('#');
        conforms(value, root.pointer(pointer).unwrap(), root)?;
    }
    for any in ["anyOf", "oneOf"].iter().filter_map(|word| schema.get(word)?.as_array()) {
        let problems: Vec<_> = any.iter().filter_map(|schema| conforms(value, schema, root).err()).collect();
        if problems.len() == any.len() {
            return Err(problems.join(" / "));
        }
    }
    let kind = match value {
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(number) if number.is_f64() => "number",
        Value::Number(_) => "integer",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    };
    let fits = |wanted: &Value| *wanted == kind || (*wanted == "number" && kind == "integer");
    match schema.get("type") {
        Some(Value::Array(types)) if !types.iter().any(fits) => return Err(format!("{value} is no {types:?}")),
        Some(wanted @ Value::String(_)) if !fits(wanted) => return Err(format!("{value} is no {wanted}")),
        _ => {}
    }
    if schema.get("const").is_some_and(|only| only != value) {
        return Err(format!("{value} is not {}", schema["const"]));
    }
    if schema.get("enum").is_some_and(|all| !all.as_array().unwrap().contains(value)) {
        return Err(format!("{value} is none of {}", schema["enum"]));
    }
    for item in value.as_array().into_iter().flatten() {
        schema.get("items").map_or(Ok(()), |schema| conforms(item, schema, root))?;
    }
    for required in schema.get("required").and_then(Value::as_array).into_iter().flatten() {
        if value.get(required.as_str().unwrap()).is_none() {
            return Err(format!("no {required}"));
        }
    }
    for (key, value) in value.as_object().into_iter().flatten() {
        match schema.get("properties").and_then(|properties| properties.get(key)) {
            Some(schema) => conforms(value, schema, root).map_err(|problem| format!("{key}: {problem}"))?,
            None if schema.get("additionalProperties") == Some(&json!(false)) => return Err(format!("no key {key}")),
            None => {}
        }
    }
    Ok(())
}

fn check(text: &str) -> Result<(), String> {
    let schema = serde_json::to_value(schema()).unwrap();
    let value: Value = toml::from_str(text).unwrap();
    conforms(&value, &schema, &schema)
}

#[test]
fn every_shipped_scenario_has_the_structure_of_the_schema() {
    for file in shipped() {
        check(&fs::read_to_string(&file).unwrap()).unwrap_or_else(|problem| panic!("{}: {problem}", file.display()));
    }
}

#[test]
fn the_schema_refuses_what_the_loader_refuses() {
    check(GOOD).unwrap();
    for (from, to) in [
        ("radius_m = 0.5", "radius_cm = 50"),
        ("radius_m = 0.5", "radius_m = \"wide\""),
        ("kind = \"circle\"", "kind = \"cycle\""),
        ("seed = 1\n", ""),
        ("seed = 1", "seed = 1.5"),
        ("laboratory", "moon"),
    ] {
        let text = GOOD.replace(from, to);
        assert!(check(&text).is_err() && parse(&text).is_err(), "{to}");
    }
    for table in
        ["[estimator.params.surf]\nmax_features = \"all\"", "[estimator.params]\nsurv = 1", "[fault]\nat_s = 1"]
    {
        let text = format!("{GOOD}{table}\n");
        assert!(check(&text).is_err() && parse(&text).is_err(), "{table}");
    }
}

#[test]
fn every_property_of_a_robots_scenario_is_described() {
    let schema = serde_json::to_value(schema()).unwrap();
    for (name, schema) in schema["$defs"].as_object().unwrap() {
        for (key, property) in schema.get("properties").and_then(Value::as_object).into_iter().flatten() {
            assert!(property.get("description").is_some(), "{name}.{key}");
        }
    }
}
