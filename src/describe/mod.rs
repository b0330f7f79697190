//! Self-description: the catalog, the JSON Schema of a job, the parameter table as text. Readers of the one list of
//! fields and of the controls.

mod catalog;
mod schema;
mod table;

pub use catalog::{
    Catalog, ChoiceEntry, CodeGroup, CycleEntry, CycleSectionEntry, DefaultEntry, FieldEntry,
    PostEntry, RelationEntry, RuleEntry, SectionEntry, SupportEntry, catalog,
};
pub use schema::job_schema;
pub use table::{export_table, export_table_with_calls};
