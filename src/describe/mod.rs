//! Self-description: the catalog, the JSON Schema of a job, and the parameter table as text. All are read from the list of fields and the controls.

mod catalog;
mod schema;
mod table;

pub use catalog::{
    Catalog, ChoiceEntry, CodeGroup, CycleEntry, CycleSectionEntry, DefaultEntry, FieldEntry,
    PostEntry, RelationEntry, RuleEntry, SectionEntry, SupportEntry, catalog,
};
pub use schema::job_schema;
pub use table::{export_table, export_table_with_calls};
