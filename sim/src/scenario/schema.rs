//! The JSON Schema of scenario files, for editors.

use schemars::{Schema, SchemaGenerator, json_schema, schema_for};
use serde_json::{Map, Value, json};
use sunblind_estimator::EstimatorParams;

use super::AnyScenario;

/// What a scenario file may hold.
pub fn schema() -> Schema {
    schema_for!(AnyScenario)
}

/// From the defaults: the estimator knows nothing of schemas.
pub(super) fn estimator_params(_: &mut SchemaGenerator) -> Schema {
    let defaults =
        serde_json::to_value(EstimatorParams::default()).expect("the parameters are plain numbers and names");
    match like(&defaults) {
        Value::Object(object) => object.into(),
        _ => json_schema!(true),
    }
}

/// The schema of values like this one.
fn like(example: &Value) -> Value {
    match example {
        Value::Object(fields) => {
            let properties: Map<_, _> = fields.iter().map(|(key, value)| (key.clone(), like(value))).collect();
            json!({ "type": "object", "properties": properties, "additionalProperties": false })
        }
        Value::Number(number) if number.is_f64() => json!({ "type": "number" }),
        Value::Number(_) => json!({ "type": "integer" }),
        Value::Bool(_) => json!({ "type": "boolean" }),
        Value::String(_) => json!({ "type": "string" }),
        // Nothing is known of what may stand there.
        Value::Array(_) | Value::Null => json!(true),
    }
}
